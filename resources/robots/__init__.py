"""Robot files that ship with the program."""
