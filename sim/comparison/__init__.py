"""Comparison of nominal model and record."""
