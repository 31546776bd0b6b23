"""Trajectories before they are played: limits, speed, duration, motion profiles."""
