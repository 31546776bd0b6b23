"""Disturbances of a sensor: noise, coarse steps, spikes, drift, lost steps, vibration.

``disturbances`` sets them aside before any fit, because commands do not cause them. Each other
module detects one kind. Comparison, examination and pipeline use it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
