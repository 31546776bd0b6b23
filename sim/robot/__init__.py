"""Robot files: the description of a machine's axes."""
