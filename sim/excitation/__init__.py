"""Test motions within the limits of a machine. Each kind reveals one property of the machine.

``generator`` makes a playable trajectory from signals such as sines, steps or sweeps, and
``quantity`` reads amounts that users type. The command line, the panels, and the calibration and
diagnosis use it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
