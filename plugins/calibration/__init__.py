"""The panel of sensor calibration."""
