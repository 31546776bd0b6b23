"""The command `rotemina`."""
