"""Comparison of hypotheses by their remainders on data that their fits did not use."""
