"""Optional abilities of devices, each a base class from which a driver may inherit.

``abilities`` has those of real devices, ``model_abilities`` those of simulators; ``profile`` and
``capture`` hold the data that they exchange. Authors of drivers import from here, and the
application checks by ``isinstance`` what a device can do.
"""

import lazy_loader

from rotemina.sim.compatibility import add_names_of_former_module

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
__getattr__ = add_names_of_former_module(__getattr__, "rotemina.drivers.abilities.abilities")
