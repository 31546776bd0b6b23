"""The camera contract, and the built-in cameras.

Authors of cameras derive from ``CameraSource`` and ``Camera``. ``hub`` finds the cameras of all
sources. ``opencv``, ``sequence``, ``micromanager`` and ``simulated`` are the built-in ones. Cameras
in use, with their threads, are in ``app/cameras``.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
