"""Diagnosis of the sim-to-real gap.

Where the gap is, what causes it, and how far it shrinks.
"""
