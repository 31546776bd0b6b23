"""Effects of the running simulator."""
