"""Motion profiles and input shaping, for moves that leave little vibration.

``moves`` has moves from rest to rest, ``impulses`` shapes them, and ``cubic_segments`` converts
them for boards. Penetration, compensation and tuning use it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
