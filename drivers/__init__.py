"""The driver contract, and the built-in drivers.

This folder exports the names of ``contract`` that every author of a driver needs. ``abilities``
holds what only some devices can do, and ``conformance`` checks a driver. ``cameras`` and ``inputs``
have contracts for other kinds of devices. The application and plugins may import from here.
"""

import lazy_loader

from rotemina.sim.compatibility import serve_former_modules

serve_former_modules()

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
