"""Types of arrays, and functions on arrays that several folders need.

The types of numpy arrays have names such as ``FloatArray``; functions make arrays read-only and
thin signals for drawing. Any folder may use it.
"""

import lazy_loader

from rotemina.sim.compatibility import add_names_of_former_module

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
__getattr__ = add_names_of_former_module(__getattr__, "rotemina.sim.arrays.arrays")
