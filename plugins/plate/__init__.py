"""The holding plate in 3-D."""
