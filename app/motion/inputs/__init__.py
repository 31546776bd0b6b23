"""Operator inputs: readings of joysticks and other devices become one intent.

``input_devices`` finds, opens and reads the devices, and ``input_arbiter`` merges them. Further
modules hold mapping profiles, calibration, and the checks that decide which reading may move a
machine. Teleoperation and the Input devices panel use it. The devices are in ``drivers/inputs``.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
