"""Tuning of a loop: a Pareto search for gains on the simulated axis.

``search`` looks for gains, ``pareto_front`` recommends one set, and ``tuning_result`` stores it.
``rotemina tune`` and the Compensation panel use it. The loops themselves are in ``sim/feedback``.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
