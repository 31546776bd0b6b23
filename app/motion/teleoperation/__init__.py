"""Teleoperation: turns readings of input devices into motion of axes.

``teleoperation_loop`` runs it. ``modes`` lists what a stick can steer, ``frames`` maps a mode to
the axes, and the laws of scaling turn a deflection into a distance, a speed or a force. The
operation loop and the Teleoperation panel use it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
