"""Microscope panel: the picture, and motion by the microscope."""
