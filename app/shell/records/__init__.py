"""Choosing records and files: tables of the library, dialogs, and reports.

The dialogs keep the window and its stop button usable. Window and panels may use them. The library
itself, without Qt, is in ``app/records``.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
