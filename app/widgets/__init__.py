"""Widgets shared by window and panels.

They are independent of panels and machine.
"""
