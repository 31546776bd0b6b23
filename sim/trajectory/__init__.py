"""Limits, duration and profiles of trajectories."""
