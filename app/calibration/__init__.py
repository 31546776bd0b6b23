"""Sensor calibrations and axes' health.

A user makes, stores and applies calibrations. No Qt.
"""
