"""Distance: a plugin (panel) for RoTeMiNa."""
