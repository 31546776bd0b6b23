"""Faults panel: what went wrong and when, and faults on purpose for training."""
