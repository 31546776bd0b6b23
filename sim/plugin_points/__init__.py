"""The five groups of entry points: interface versions, trial imports, and loading of plugins.

``loading`` has the version of each interface, and refuses plugins of another one. It is in the
lowest layer because effects are loaded there. Everything that loads plugins uses it.
"""

import lazy_loader

from rotemina.sim.compatibility import add_names_of_former_module

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
__getattr__ = add_names_of_former_module(__getattr__, "rotemina.sim.plugin_points.loading")
