"""Errors of the model layer, with the base classes of all errors whose text is a message.

All other folders may import them. They themselves import only the messages.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
