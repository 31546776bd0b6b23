"""USB and Bluetooth joysticks and gamepads: any that describes itself by a HID descriptor."""
