"""Panel for automatic cell penetration: parameters, preview, run and log.

``form`` has the parameters, ``plan_preview`` their preview, and ``run_bar`` the buttons. The folder
exports its buttons and texts, which other panels show as well.
"""

import lazy_loader

from rotemina.app.language import make_text_functions

tr, mark = make_text_functions("penetration")

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
