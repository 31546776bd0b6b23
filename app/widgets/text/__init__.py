"""Labels, tables, and columns of names and values.

``labels`` has elided lines and headings, ``figures`` two columns of names and values, and ``table``
read-only tables. Window and panels use this folder.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
