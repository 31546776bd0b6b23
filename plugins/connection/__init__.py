"""Connection panel: the device, its settings, and what the operator must know before it moves."""
