"""Errors of the diagnosis, and the thresholds of its decisions.

``thresholds`` has the figures that several steps share, such as the share of a gap that a cause
must close. A figure of one step is in the module of this step. Every step of a diagnosis may use
it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
