"""Vibration modes, state space and stability of a machine for small motions.

``state_space`` has the matrices of the equation of motion, ``vibration`` frequencies and shapes,
and ``stability`` the check of coupled axes. Effects are left out. The penetration and the tests use
it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
