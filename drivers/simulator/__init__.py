"""The built-in simulator, a driver with the same contract as the drivers of real devices.

``driver`` is the driver. ``device`` is the simulated machine, which runs in device time without a
thread; virtual boards and the simulated microscope use parts of it. The equations are in
``sim/plant``.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
