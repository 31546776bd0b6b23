"""Records and trajectories, as ASCII files.

A file holds all joints over time.
"""
