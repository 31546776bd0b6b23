"""Driver of stages with a GRBL controller, and an emulated stage.

A stage is connected by a serial line and moved by G-code. The driver supports GRBL, grblHAL and
FluidNC controllers. ``emulator``, ``parser`` and ``blocks`` emulate a controller for ``rotemina
stage`` and the tests; the other modules belong to the driver.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
