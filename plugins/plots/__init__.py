"""Per-axis time plots of command, model and measurement."""
