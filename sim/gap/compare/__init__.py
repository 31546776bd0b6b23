"""Hypotheses weighed by what they leave of data that their fits have not seen."""
