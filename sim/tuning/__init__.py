"""Gains of a loop by a Pareto search on the simulated axis, and trials of any of them."""
