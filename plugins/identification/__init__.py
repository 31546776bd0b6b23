"""Identification from a record: frequency response, loop, steps, a fitted model."""
