"""Playback of trajectories under an operator's control, and the comparison of the played run.

``playback`` plays, pauses and steps on a real device; ``offline_playback`` plays faster than real
time on a simulated one. ``compared_run`` compares the record with the model. Window, command line
and panels use it.
"""

import lazy_loader

from rotemina.sim.compatibility import add_names_of_former_module

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
__getattr__ = add_names_of_former_module(__getattr__, "rotemina.app.motion.playback.playback")
