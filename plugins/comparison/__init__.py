"""Comparison of model and record."""
