"""Comparison of hypotheses on unseen data.

Their remainders are compared on data that their fits did not use. ``forward_selection`` adds causes
one by one, ``rivals`` and ``cause_contest`` test each against effects that could replace it, and
``verdict`` decides what may be said. Examination, experiment and pipeline use it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
