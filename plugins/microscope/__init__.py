"""The microscope picture, and motion by it."""
