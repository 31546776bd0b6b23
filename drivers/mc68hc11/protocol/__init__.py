"""The protocol of the MC68HC11 boards: frames, messages, codes, axes and parameters.

It knows no port and no thread. ``framing`` turns frames into bytes, ``host_messages`` and
``board_messages`` are their contents. The driver and the virtual boards use it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
