"""Output-error fits of effects to records, and what they leave of data that they did not see.

``output_error`` fits, ``evidence`` has the records of an axis, and ``fit_starts`` the starting
points. All later steps of a diagnosis may use it; of the earlier ones it imports ``intake`` and
``limits``.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
