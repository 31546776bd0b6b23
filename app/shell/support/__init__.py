"""Support: the log, delays of the event loop, and the support bundle without personal names.

``message_log`` keeps notices and log records, ``event_loop_watch`` finds what made the window
stall, and ``support_bundle`` collects both. Only the window uses this folder.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
