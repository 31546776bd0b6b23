"""Start of the program: checks before Qt, the window's run, and runs without a display.

``window_start`` checks what Qt needs, ``window_run`` runs the window, and ``offscreen_run`` plays
one trajectory without a display. ``screenshots`` draws the pictures of the documentation. Only the
command line and tools start the program.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
