"""The pages of the documentation, which the program carries as its help."""
