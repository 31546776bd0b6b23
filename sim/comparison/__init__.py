"""Comparison of a record with the nominal model, and of two runs with each other.

``comparison`` compares tap by tap, ``gap`` condenses the difference to one figure, and
``run_comparison`` compares two runs of a machine. Any layer may use it. The causes of a gap are the
subject of ``sim/gap``.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
