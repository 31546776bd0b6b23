"""Subcommands for controllers: compensation of hysteresis, and the search for gains.

Each module is one subcommand: it reads the arguments, calls ``sim``, and prints. Only the command
line uses it; ``rotemina play`` loads inverses through it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
