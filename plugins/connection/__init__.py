"""Connection panel: the device, its settings, and conditions for motion."""
