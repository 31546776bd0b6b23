"""Limits of motion: ranges of the axes, and the bounds of the tip. They apply on every path.

``guard`` checks each request. An operator can narrow the ranges of a robot file, but never widen
them. The session enforces the limits; panels use this folder only to show them.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
