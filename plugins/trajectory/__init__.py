"""Trajectories: load, dry run, play."""
