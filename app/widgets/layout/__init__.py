"""Rows, columns, sections, scroll areas, and questions inside a panel.

``layouts`` makes a row, column or grid by one call, ``section`` is the heading with a column of
widgets, and ``inline_question`` asks without a dialog. Window and panels use this folder.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
