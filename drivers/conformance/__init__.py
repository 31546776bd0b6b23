"""Conformance checks of the driver contract.

Every driver must pass these checks. ``rotemina driver check`` runs them, and so do the tests of a
driver, on a ``DriverBench``. ``suite`` lists all checks; the other modules hold them by subject.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
