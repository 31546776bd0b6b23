"""Colours of the window, and work that waits for the style or the visibility of a widget.

``theme`` names the colours by role. ``OnStyleChange`` adapts sizes to the text, and ``OnVisible``
delays drawing until its widget is visible. Window and panels use this folder.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
