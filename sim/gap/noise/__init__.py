"""Disturbances of a sensor: noise, coarse steps, spikes, drift, lost steps, vibration."""
