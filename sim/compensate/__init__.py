"""Inverse models of a piezo: hysteresis, creep and lag, trained, checked and run by sample."""
