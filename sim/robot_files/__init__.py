"""Robot files: strict reading, checks of consistency, and writing.

``reading`` turns a TOML file into a ``Robot`` and names each error with its key, value and bound.
``consistency`` checks values against each other. All layers and plugins may import from here.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
