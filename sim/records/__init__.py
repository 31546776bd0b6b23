"""Records and trajectories, and their ASCII files, which contain all axes over time.

``record`` has the class, ``reading``, ``record_pieces`` and ``writing`` read and write files, and
``resampling`` changes the grid. All layers and plugins may import from here.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
