"""Compensation of hysteresis: learn an inverse, check it, put it on, tune a loop around it."""
