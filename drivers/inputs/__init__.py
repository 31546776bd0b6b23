"""Input devices: joysticks, gamepads, potentiometers and keys, behind one contract."""
