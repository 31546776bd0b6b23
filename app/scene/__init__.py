"""The robot as a 3-D scene: drawing commands, their projection to a picture, and a web server.

``robot_scene`` decides what is drawn, ``projected_picture`` draws it without a GPU, and ``server``
shows it in browsers. It does not depend on Qt. Only the panel of the 3-D view uses it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
