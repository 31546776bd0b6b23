"""The MC68HC11 boards on a serial line."""
