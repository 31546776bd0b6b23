"""The driver contract: base class, axes, samples, errors, the gate, and the search for drivers.

``driver`` has the base class, which enforces the rules. ``gate`` refuses everything that was
requested before the latest stop. Authors of drivers import from ``rotemina.drivers``, which exports
what they need; the application and the built-in drivers import from here as well.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
