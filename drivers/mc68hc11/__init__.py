"""Driver of the MC68HC11 boards, which are connected by serial lines.

``driver`` is the driver, and ``serial_link``, ``dialogue`` and ``board`` are its way to a board.
``wire_guard`` checks each command last. ``protocol`` has the messages, and ``firmware`` routines of
the boards. The program finds the driver by its entry point; the virtual boards share ``protocol``.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
