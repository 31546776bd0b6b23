"""Cell penetration, from approach to retraction.

Its phases are approach, contact, thrust, hold, inject and retract. ``penetration`` is the interface
for panels, ``sequence`` has the actions of each phase, and ``detector`` recognises the contact.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
