"""Calibration of the axes' own sensors against an independent reference, such as a laser."""
