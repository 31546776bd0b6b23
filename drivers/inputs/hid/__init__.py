"""USB and Bluetooth joysticks and gamepads with a HID descriptor."""
