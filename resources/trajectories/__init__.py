"""Example trajectories."""
