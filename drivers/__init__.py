"""How devices are reached: the driver contract and the built-in drivers. Free of Qt."""
