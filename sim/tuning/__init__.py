"""Gains by a Pareto search."""
