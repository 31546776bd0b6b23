"""Effects, one module each."""
