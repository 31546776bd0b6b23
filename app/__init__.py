"""The motion session, commands and the window.

The window hosts the panels.
"""
