"""Messages as data, and numbers as text.

``messages`` keeps a template apart from its values, so that the window can translate it, and
``number_text`` rounds. Errors with such messages are in ``sim/errors``. Any folder may use it.
"""

import lazy_loader

from rotemina.sim.compatibility import add_names_of_former_module

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
__getattr__ = add_names_of_former_module(__getattr__, "rotemina.sim.messages.messages")
