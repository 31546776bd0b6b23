"""Published models of the machine."""
