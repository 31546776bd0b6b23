"""Published models of the machine that ship with the program."""
