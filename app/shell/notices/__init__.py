"""Notices over the window, placed so that they cover nothing that is in use.

``notices`` shows, repeats and removes them, and ``free_places`` finds room. Only the window uses
this folder; a panel posts a notice with ``workbench.notify``.
"""

import lazy_loader

from rotemina.sim.compatibility import add_names_of_former_module

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
__getattr__ = add_names_of_former_module(__getattr__, "rotemina.app.shell.notices.notices")
