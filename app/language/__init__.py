"""The language of window and command line, and numbers, units and engine texts as they are shown.

``display_units`` turns values in m and rad into texts, and ``engine_words`` translates words of the
layers below. Panels, widgets and the command line use it. Nothing here depends on the window.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
