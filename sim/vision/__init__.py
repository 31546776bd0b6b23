"""Measurements in images: registration, calibration, focus, drift, the tip and the cell.

Pixels are (column, row), counted from the centre of the upper left one. A measurement returns its
uncertainty, or raises an error that gives the reason why it cannot be made. It knows no camera;
``app/microscope`` takes the pictures.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
