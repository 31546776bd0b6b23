"""Microscope panel: the picture, and what the microscope does with the machine."""
