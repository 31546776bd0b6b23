"""The window (Qt).

The window hosts the panels.
"""
