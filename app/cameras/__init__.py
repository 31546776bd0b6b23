"""Cameras in use, one thread each.

All readers get the newest picture of a ``CameraFeed``. The folder also saves pictures, stacks and
videos. The cameras themselves are in ``drivers/cameras``. It does not depend on Qt.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
