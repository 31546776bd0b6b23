"""Compensation of hysteresis."""
