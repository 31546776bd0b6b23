"""The motion session, the only interface through which a program moves a machine.

The session's requests are one module each: moves, ranges, compensation, feedback, profiles and
others. All pass the checks of ``admission``. Panels reach the session as ``workbench.session``.
"""

import lazy_loader

from rotemina.sim.compatibility import add_names_of_former_module

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
__getattr__ = add_names_of_former_module(__getattr__, "rotemina.app.motion.session.session")
