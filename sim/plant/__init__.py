"""The nominal plant: equation of motion, exact sampling, control loops, and effects on them.

``plant`` steps a machine, ``assembly`` builds it from a robot and its effects, and ``kernel`` is
the compiled loop. ``record_response`` computes the response to the commands of a record. The
simulator, the diagnosis and the live models use it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
