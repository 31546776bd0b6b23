"""Automatic cell penetration: parameters, their consequences, the run, and the log."""
