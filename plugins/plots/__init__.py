"""Live plots of each axis."""
