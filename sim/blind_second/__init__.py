"""A second, independent generator of blind test cases.

It shares no equations with the first generator, the effects and the diagnosis, and imports none of
them. ``case`` draws machines, labels and records. Only ``app/blind`` uses it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
