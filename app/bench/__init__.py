"""Diagnosis of machines with known causes.

Each diagnosis is set beside the truth.
"""
