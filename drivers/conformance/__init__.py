"""Checks of the driver contract."""
