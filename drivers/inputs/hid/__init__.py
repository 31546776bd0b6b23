"""HID joysticks and gamepads.

Devices on USB and Bluetooth that have a HID descriptor.
"""
