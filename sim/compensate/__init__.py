"""Inverse models of a piezo axis, which compensate hysteresis, creep and lag.

They are trained and checked on records (``training``, ``judgement``), and run sample by sample
(``inverse``). ``file`` stores them. The session, the command line and the Compensation panel use
them.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
