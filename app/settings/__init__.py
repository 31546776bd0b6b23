"""The user's preferences and the files that operators edit, written completely or not at all.

``settings`` stores preferences between starts, ``driver_settings`` those of drivers, and
``toml_file`` reads and writes files strictly. Anything in ``app`` and all panels may use it.
"""

import lazy_loader

from rotemina.sim.compatibility import add_names_of_former_module

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
__getattr__ = add_names_of_former_module(__getattr__, "rotemina.app.settings.settings")
