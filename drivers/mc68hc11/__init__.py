"""The MC68HC11 boards: how they are spoken to over a serial line."""
