"""Motion profiles and input shaping: shapes of a move that leave little vibration."""
