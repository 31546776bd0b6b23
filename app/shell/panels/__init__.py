"""The panels of a window: found, created when needed, watched, and left out if they fail.

``panel_host`` finds and creates the panels, ``deferred_panels`` delays those that are not seen, and
``panel_watch`` removes panels of other packages that raise. Window and start use it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
