"""Motion profiles and input shaping."""
