"""Simulated records of a robot with effects and noise, and the checks of effects.

``simulation`` writes records as a real machine would. The modules ``check_…`` check an effect
against its own description; authors of effects test with ``check_effect``. The command line uses
both.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
