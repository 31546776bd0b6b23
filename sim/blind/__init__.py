"""Test cases for the blind self-test of the diagnosis.

The cases are simulated with equations that the diagnosis does not use, so it must not import
``sim/effects`` or ``sim/gap``, nor they this folder. ``case`` draws a machine, ``sealing`` hides
its answer, and ``scoring`` scores a diagnosis. ``sim/blind_second`` is a second generator,
independent of this one. Only ``app/blind`` and the blind test in the window use it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
