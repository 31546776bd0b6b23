"""Location of the gap: axis, tap, frequency band, regime, and what the gap depends on.

``located_gap`` is the result. ``bands`` splits a gap by frequency, ``regimes`` by what the axis was
doing, and ``residual_features`` asks what the gap depends on. Later steps and reports use it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
