"""Session recordings and library."""
