"""Effects, one module each.

An effect is a deviation of a real axis from the nominal plant. Authors of effects import from here:
``formulation`` has the parts of an effect, ``step`` its compiled functions, and ``registry`` finds
the installed ones. ``identification``, ``kinship`` and ``starts`` help a diagnosis to find an
effect.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
