"""Inverse models of a piezo: hysteresis, creep and lag, learned, judged and run by the sample."""
