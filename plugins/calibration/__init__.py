"""Sensor calibration panel."""
