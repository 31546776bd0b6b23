"""One picture of a camera."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

#: Grey (rows, columns) of uint8 or uint16, or red, green, blue (rows, columns, 3) of uint8.
Pixels = NDArray[np.uint8] | NDArray[np.uint16]
Remark = bool | int | float | str


@dataclass(frozen=True, slots=True)
class Region:
    """A part of the sensor, px: the first column and row, and how many there are."""

    left: int
    top: int
    width: int
    height: int


@dataclass(frozen=True, slots=True, eq=False)
class Frame:
    """One picture.

    Attributes
    ----------
    pixels : array
        Read-only; see :data:`Pixels`. ``pixels[v, u]`` is row v, column u of the region.
    host_time_s : float
        When it came in, on the host's monotonic clock.
    number : int
        Counted by the camera since it was opened, from 0; lost ones are left out of the pictures,
        not of the numbers.
    bits : int
        Significant ones: 12 for a camera of 12 bits, whose numbers end at 4095.
    region : Region
        The part of the sensor that is shown.
    exposure_s : float or None
        None where the camera does not tell it.
    lost : int
        How many the camera has taken since it was opened that nobody can have any more, and reads
        that failed.
    metadata : mapping
        What else the camera tells, by name.
    noise_free : bool
        Whether two pictures of the camera may be equal; see :class:`CameraDescription`.
    """

    pixels: Pixels
    host_time_s: float
    number: int
    bits: int
    region: Region
    exposure_s: float | None = None
    lost: int = 0
    metadata: Mapping[str, Remark] = field(default_factory=lambda: MappingProxyType({}))
    noise_free: bool = False

    def __post_init__(self) -> None:
        view = self.pixels.view()
        view.flags.writeable = False
        object.__setattr__(self, "pixels", view)

    @property
    def largest(self) -> int:
        """The number of a saturated pixel."""
        return (1 << self.bits) - 1

    @property
    def colour(self) -> bool:
        """Whether it has red, green and blue."""
        return self.pixels.ndim == 3
