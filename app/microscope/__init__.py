"""Microscope services: calibration, click-to-move, autofocus, z-stacks, tip tracking, measurements.

``microscope`` is the interface for panels. The modules named ``…_run`` are procedures that move
axes and take pictures. The evaluation of pictures is in ``sim/vision``. It does not depend on Qt.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
