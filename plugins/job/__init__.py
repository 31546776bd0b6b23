"""The running job and its progress."""
