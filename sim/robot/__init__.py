"""The description of a machine: axes, couplings, sensors, and the plate that holds the pin.

``model`` has the classes, which pydantic checks, and assembles the matrices of the equation of
motion. Robot files are read in ``sim/robot_files``. All layers and plugins may import from here.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
