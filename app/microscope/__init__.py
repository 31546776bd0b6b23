"""Microscope calibration, click-to-move, measurements."""
