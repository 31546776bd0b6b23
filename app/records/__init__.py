"""The library of played, recorded and opened records, and reports about them.

``library`` finds and opens records, ``database`` stores their facts, names and notes, and
``run_report`` writes a page about one of them. It does not depend on Qt, so that the command line
and the window can use it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
