"""Comparison of the model with a real record."""
