"""Controllers and their loops' stability."""
