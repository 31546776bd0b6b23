"""Input devices, such as joysticks, gamepads, potentiometers and keys, with one contract.

Authors of input devices derive from ``InputSource`` and ``InputDevice``. ``hub`` finds the devices
of all sources. The modules ``hid_…`` read joysticks and gamepads that have a HID report descriptor.
What a deflection means for the machine is decided in ``app/motion/inputs``.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
