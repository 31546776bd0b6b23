"""The simulated microscope: pictures of the tip, the pin and a cell.

``renderer`` draws a ``MicroscopeScene`` through the optics. The simulated camera in
``drivers/cameras`` uses it, and so do the 3-D scene and the microscope services.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
