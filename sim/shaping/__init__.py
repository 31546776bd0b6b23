"""Motion profiles and input shaping.

Shapes of a move that leave little vibration.
"""
