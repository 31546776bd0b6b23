"""Live plots of each axis.

Command, model and measurement over time.
"""
