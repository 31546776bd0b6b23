"""Limits, duration and profiles of trajectories.

All of them are checked before a trajectory is played.
"""
