"""The link to a device: the worker that calls the driver, its queue, and the samples.

``worker`` is the only object that calls the driver, except for ``stop``. Other threads reach it
through ``mailbox``. ``ownership`` says who may move an axis, and ``recent_history`` holds the
latest samples. Panels read the history and name owners; motion is requested only through the
session.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
