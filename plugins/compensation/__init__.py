"""Compensation of hysteresis: train, check and apply an inverse, and tune a loop around it."""
