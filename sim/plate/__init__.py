"""Finite element model of the holding plate: stiffness, stress, modes, and friction of the pin.

``statics`` and ``modes`` solve the plate, ``stress`` derives its stress, and ``robot_entries``
gives the figures for a robot file. The Plate panel and ``rotemina plate`` use it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
