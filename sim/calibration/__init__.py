"""Calibration of a sensor against an independent reference, such as a laser.

``sensor_calibration`` computes a calibration from records, ``plan`` makes the motion for it, and
``correction`` applies it to new readings. ``app/calibration`` stores calibrations and those in use.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
