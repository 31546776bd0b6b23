"""MC68HC11 boards on serial lines."""
