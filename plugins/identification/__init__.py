"""Identification from a record.

Frequency response, loop, steps, fitted model and health card.
"""
