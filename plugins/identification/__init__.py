"""Identification from a record."""
