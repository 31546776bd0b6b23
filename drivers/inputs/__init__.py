"""Input devices behind one contract.

Joysticks, gamepads, potentiometers and keys.
"""
