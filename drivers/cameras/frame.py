"""One picture of a camera, with the types and the conversion of its pixels."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rotemina.sim.compatibility import FormerMember, serve_former_names

#: Grey (rows, columns) of uint8 or uint16, or red, green, blue (rows, columns, 3) of uint8.
Pixels = NDArray[np.uint8] | NDArray[np.uint16]
MetadataValue = bool | int | float | str


class PixelType(StrEnum):
    """The type of a pixel."""

    MONO8 = "mono8"
    MONO16 = "mono16"
    COLOUR = "colour"


@dataclass(frozen=True, slots=True)
class SensorRegion:
    """A rectangle on the sensor, px: its first column and row, its width and height."""

    left: int
    top: int
    width: int
    height: int


@dataclass(frozen=True, slots=True, eq=False)
class CameraFrame:
    """One picture of a camera.

    Attributes
    ----------
    pixels : array
        Read-only; see :data:`Pixels`. ``pixels[v, u]`` is row v, column u of the region.
    host_time_s : float
        Time of arrival on the host's monotonic clock.
    number : int
        Number of the picture since the camera was opened, from 0. Lost pictures are numbered too,
        so that the numbers show gaps.
    bits : int
        Number of significant bits, such as 12 for a camera whose largest pixel value is 4095.
    region : SensorRegion
        The part of the sensor that is shown.
    exposure_s : float or None
        None if the camera does not report it.
    lost : int
        Number of lost pictures and failed reads since the camera was opened.
    metadata : mapping
        Other values that the camera reports, by name.
    noise_free : bool
        Whether two pictures of the camera may be equal; see :class:`CameraDescription`.
    """

    pixels: Pixels
    host_time_s: float
    number: int
    bits: int
    region: SensorRegion
    exposure_s: float | None = None
    lost: int = 0
    metadata: Mapping[str, MetadataValue] = field(default_factory=lambda: MappingProxyType({}))
    noise_free: bool = False

    def __post_init__(self) -> None:
        view = self.pixels.view()
        view.flags.writeable = False
        object.__setattr__(self, "pixels", view)

    @property
    def saturation_value(self) -> int:
        """The value of a saturated pixel."""
        return (1 << self.bits) - 1

    @property
    def is_colour(self) -> bool:
        """Whether the pixels consist of red, green and blue."""
        return self.pixels.ndim == 3

    # Former names, which work for one more release.
    colour = FormerMember("is_colour")
    largest = FormerMember("saturation_value")


def find_pixel_type(pixels: Pixels) -> PixelType:
    """Return the type of an array of pixels; see :data:`Pixels`."""
    if pixels.ndim == 3:
        return PixelType.COLOUR
    return PixelType.MONO8 if pixels.dtype == np.uint8 else PixelType.MONO16


def is_pixel_array(pixels: object) -> bool:
    """Return whether an object is a non-empty array that :data:`Pixels` permits."""
    if not isinstance(pixels, np.ndarray) or not pixels.size:
        return False
    if pixels.ndim == 3:
        return bool(pixels.shape[2] == 3 and pixels.dtype == np.uint8)
    return pixels.ndim == 2 and pixels.dtype in (np.uint8, np.uint16)


def convert_to_mono8(pixels: Pixels, bits: int) -> Pixels:
    """Convert pixels with ``bits`` significant bits to 8-bit grey (rows, columns).

    Colour is converted to luma (ITU-R BT.601). If there are more than 8 bits, the upper 8 are used.
    """
    # Loaded here, because most users of frames do not convert any.
    import cv2

    if pixels.ndim == 3:
        return np.asarray(cv2.cvtColor(pixels, cv2.COLOR_RGB2GRAY), dtype=np.uint8)
    if pixels.dtype == np.uint8:
        return pixels
    return np.asarray(np.minimum(pixels >> max(bits - 8, 0), 255), dtype=np.uint8)


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        Frame="CameraFrame",
        Region="SensorRegion",
        Remark="MetadataValue",
    )
