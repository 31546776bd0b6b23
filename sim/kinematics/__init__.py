"""Kinematics of the hybrid chain: micro tables that carry a tilting, extending nano stage.

The folder contains forward and inverse kinematics, the workspace of the tip, and its keep-out zone.
``chain`` describes the joints. Motion, the 3-D scene and the panels use it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
