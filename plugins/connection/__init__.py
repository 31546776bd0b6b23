"""Device, its settings, conditions for motion."""
