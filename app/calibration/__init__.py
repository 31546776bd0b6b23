"""Sensor calibrations and the health of the axes.

The folder makes, stores and applies calibrations, and compares health figures over time. ``sim``
computes both. It does not depend on Qt, so that the command line and the panels can use it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
