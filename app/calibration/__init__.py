"""Sensor calibrations made, stored and applied by a user, and the axes' health. No Qt."""
