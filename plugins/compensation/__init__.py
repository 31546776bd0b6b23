"""Compensation of hysteresis.

Train, check and apply an inverse, and tune a loop around it.
"""
