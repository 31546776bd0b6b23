"""Example trajectories that are shipped with the program."""
