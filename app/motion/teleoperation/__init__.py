"""From stick readings to motion."""
