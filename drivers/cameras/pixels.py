"""Conversion of pixels to another type."""

import cv2
import numpy as np

from rotemina.drivers.cameras.frame import Pixels
from rotemina.drivers.cameras.settings import PixelType


def pixel_type_of(pixels: Pixels) -> PixelType:
    """Return the type of pixels; see :data:`Pixels`."""
    if pixels.ndim == 3:
        return PixelType.COLOUR
    return PixelType.MONO8 if pixels.dtype == np.uint8 else PixelType.MONO16


def are_pixels(pixels: object) -> bool:
    """Return whether something is a picture as :data:`Pixels` describes it."""
    if not isinstance(pixels, np.ndarray) or not pixels.size:
        return False
    if pixels.ndim == 3:
        return bool(pixels.shape[2] == 3 and pixels.dtype == np.uint8)
    return pixels.ndim == 2 and pixels.dtype in (np.uint8, np.uint16)


def as_mono8(pixels: Pixels, bits: int) -> Pixels:
    """Return grey (rows, columns) of 8 bits of pixels with so many significant ``bits``.

    Of colour the luma is taken (ITU-R BT.601); of more bits the upper ones.
    """
    if pixels.ndim == 3:
        return np.asarray(cv2.cvtColor(pixels, cv2.COLOR_RGB2GRAY), dtype=np.uint8)
    if pixels.dtype == np.uint8:
        return pixels
    return np.asarray(np.minimum(pixels >> max(bits - 8, 0), 255), dtype=np.uint8)
