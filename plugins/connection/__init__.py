"""The Connection panel: the device, its settings, and the conditions for motion.

Each section of the panel is one module. The folder exports the reasons why homing and similar
actions are unavailable, which other panels show as well.
"""

import lazy_loader

from rotemina.app.language import make_text_functions

tr, mark = make_text_functions("connection")

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
