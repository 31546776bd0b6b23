"""The result of a diagnosis, and its progress.

``diagnosis`` has the frozen classes that reports and panels read, and ``diagnosis_progress`` what a
running diagnosis reports. Every layer may use it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
