"""The errors of the application whose messages a user reads.

Every folder of the application may import them; they need only ``rotemina.sim.messages``.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
