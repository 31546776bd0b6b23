"""Models identified from records."""
