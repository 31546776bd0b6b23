"""Access to devices: the driver contract and the built-in drivers. Free of Qt."""
