"""The interface of panel plugins: the base class, and functions that create panels.

Authors of panels derive from ``Panel`` and offer buttons in the command palette with
``offer_in_palette``. What a panel shows and requests is in ``app/workbench``.
"""

import lazy_loader

from rotemina.sim.compatibility import add_names_of_former_module

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
__getattr__ = add_names_of_former_module(__getattr__, "rotemina.app.panel.panel")
