"""The main window: header with stop buttons, menus, layouts, palette and status bar.

``main_window`` puts the parts together, and ``commands`` lists the menus as a table. Each other
module is one part. The start of the program creates the window. Panels receive the workbench
instead of the window.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
