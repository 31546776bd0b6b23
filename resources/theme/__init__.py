"""Colours and style sheet of the window."""
