"""Where the gap lies: axis, tap, frequency band, regime, and what it depends on."""
