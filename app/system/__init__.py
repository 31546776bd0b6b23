"""Checks of this computer, which ``rotemina doctor`` and the start of the window use.

``system_check`` finds missing libraries and the Qt platform, before Qt is imported.
``machine_check`` runs all checks, and ``line_rate`` tests the bit rate of a serial adapter.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
