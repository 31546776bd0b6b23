"""The state of a session, its events, and the records of what was played.

A ``SessionState`` is a frozen snapshot that all displays draw; panels receive it in their
callbacks. ``stop`` says who stopped the machine and why, and ``recorder`` extracts the record of a
playback. Anything in ``app`` and all panels may use it.
"""

import lazy_loader

from rotemina.sim.compatibility import add_names_of_former_module

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
__getattr__ = add_names_of_former_module(__getattr__, "rotemina.app.motion.state.state")
