"""Automatic cell penetration: parameters, what they give, the run, and the log of runs."""
