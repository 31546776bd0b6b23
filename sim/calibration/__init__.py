"""Sensor calibration against a reference.

The reference is independent, such as a laser.
"""
