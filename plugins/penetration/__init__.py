"""Automatic cell penetration.

Parameters, their consequences, the run and the log.
"""
