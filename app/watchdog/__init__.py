"""A separate process that reports when the program hangs or has died.

``heartbeat_sender`` starts the process and sends it heartbeats; ``process`` is its program and
imports nothing of this package. Only the start of the window uses it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
