"""Former names of interfaces, which work for one more release.

``former_modules.csv`` lists former modules with the current ones; ``former_names`` serves former
names of classes, functions and their members. Each use gives a ``DeprecationWarning``. Only the
folders that had other names before use it; remove an entry one release after the change.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
