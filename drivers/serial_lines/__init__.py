"""Serial lines that read and write bytes and never block.

``serial_port`` opens a port of this computer or a socket, and ``byte_channels`` does the reading
and writing. Drivers use it; the application sees only their settings.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
