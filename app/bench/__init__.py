"""Machines with known causes: the diagnosis of each, beside the truth."""
