"""Comparison of hypotheses on unseen data.

Their remainders are compared on data that their fits did not use.
"""
