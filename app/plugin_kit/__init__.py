"""Templates and checks for authors of plugins.

``writing`` writes the package of a new plugin, ``checking`` checks an installed one, and
``panel_bench`` opens a panel on a simulated machine. Tests of plugins and the command ``rotemina
plugin`` import from here; drivers have their checks in ``drivers/conformance``.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
