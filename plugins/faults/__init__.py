"""Faults panel: past faults, and fault injection for training."""
