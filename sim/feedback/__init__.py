"""Sampled controllers, the stability of their loops, and the simulation of these loops.

``controller`` is a PI or PID controller with filters, ``stability`` has its margins, and
``regulated_plant`` steps a plant under controllers. The session, the simulator and the search for
gains (``sim/tuning``) use it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
