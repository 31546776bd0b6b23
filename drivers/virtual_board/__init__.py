"""Virtual boards with a simulated machine.

They implement the board's side of the protocol, for ``rotemina board``, training and tests. They
need a fifth of a processor core, and the program needs another fifth. If six other processes are
busy on two cores, most playbacks end early, because set-points come too late.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
