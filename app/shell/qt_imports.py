"""What PySide does at each import of a module, without what no module needs."""

import sys


def spare_source_search() -> None:
    """Spare each import from now on a search of the module's source; PySide was imported before.

    PySide looks there for its own name, to know whether the module may switch features of Qt
    (``from __feature__ import``), and Python keeps the text of each module for good. Every module
    is taken for one that may, which costs nothing as long as none does; the search is a twentieth
    of a start, and the texts are 28 MB. A PySide without this search is left as it is.
    """
    feature = sys.modules.get("shibokensupport.feature")
    if hasattr(feature, "_mod_uses_pyside"):
        feature._mod_uses_pyside = lambda _module: True
