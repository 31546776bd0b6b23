"""Gains by a Pareto search.

The search runs on the simulated axis, which also tries any point of the front.
"""
