"""Teleoperation, with an on-screen pad.

Mode, scaling and the device in control.
"""
