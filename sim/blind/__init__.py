"""Sealed self-test of the diagnosis: cases made by equations that the diagnosis does not know."""
