"""The holding plate, by finite elements."""
