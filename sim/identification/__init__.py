"""Models of the machine identified from its records."""
