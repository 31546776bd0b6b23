"""Files that the program carries."""
