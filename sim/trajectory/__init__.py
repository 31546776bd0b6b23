"""Limits, schedule and prediction of trajectories, which are checked before they are played.

``axis_limits`` and ``checked_trajectory`` are the check of every motion, ``schedule`` the instants
at which a device applies rows, and ``trajectory_demands`` the dry run. Drivers, motion and panels
use it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
