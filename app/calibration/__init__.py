"""Calibrations of sensors as a user makes, keeps and applies them, and the axes' health. No Qt."""
