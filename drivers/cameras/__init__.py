"""Cameras: their contract, and the built-in ones."""
