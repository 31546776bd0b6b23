"""Effects that a real axis adds to the nominal plant: one module per effect."""
