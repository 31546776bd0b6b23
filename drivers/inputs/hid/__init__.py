"""HID joysticks and gamepads."""
