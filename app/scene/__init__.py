"""The robot as a 3-D scene."""
