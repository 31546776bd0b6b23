"""Units of files and screens, and quantities as readable text.

``units`` converts to and from SI, and ``quantities`` formats values and aligns columns of text. Any
folder may use it; values between folders are always SI.
"""

import lazy_loader

from rotemina.sim.compatibility import add_names_of_former_module

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
__getattr__ = add_names_of_former_module(__getattr__, "rotemina.sim.units.units")
