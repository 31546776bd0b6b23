"""Background image without the pipette, averaged from pictures in which it is elsewhere."""

from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.vision.image import Image
from rotemina.sim.vision.pipette import Pipette

# Distance from the edge of a body, in multiples of its blur, beyond which it absorbs no light.
_COVERED_BLUR_RATIO = 4.0
_COVERED_MARGIN_PX = 4.0
# Number of pictures of the running mean, which therefore follows slow changes.
_MAX_AVERAGED_PICTURES = 8.0
# Smallest share of known pixels of a region that can be divided by the background.
_MIN_KNOWN_RATIO = 0.995


@dataclass(frozen=True, slots=True, eq=False)
class BackgroundImage:
    """A background image, of which some pixels may be unknown.

    Attributes
    ----------
    image : (rows, columns)
        Mean brightness; undefined where ``picture_counts`` is 0.
    picture_counts : (rows, columns)
        Number of pictures in the mean of each pixel, up to a maximum.
    """

    image: Image
    picture_counts: Image

    @classmethod
    def empty(cls, shape: tuple[int, int]) -> Self:
        """Return a background without any known pixel."""
        return cls(np.zeros(shape, np.float32), np.zeros(shape, np.float32))

    def with_picture(
        self, image: NDArray[Any], pipette: Pipette, tip: FloatArray, depth: float
    ) -> "BackgroundImage":
        """Return the background with one more picture (rows, columns) averaged in.

        Pixels that the pipette covers remain unchanged.
        """
        is_free = ~find_covered_pixels(image.shape, pipette, tip, depth)
        pictures = np.where(
            is_free,
            np.minimum(self.picture_counts + 1.0, _MAX_AVERAGED_PICTURES),
            self.picture_counts,
        )
        weight = np.where(is_free, 1.0 / np.maximum(pictures, 1.0), 0.0).astype(np.float32)
        difference = np.asarray(image, dtype=np.float32) - self.image
        return BackgroundImage(
            self.image + weight * difference, np.asarray(pictures, dtype=np.float32)
        )

    def is_known(self, low: FloatArray, high: FloatArray) -> bool:
        """Return whether the region from column and row ``low`` (2,) to ``high`` (2,) is known."""
        begin = np.maximum(np.floor(low), 0).astype(int)
        end = np.minimum(np.ceil(high), self.image.shape[::-1]).astype(int)
        region = self.picture_counts[begin[1] : end[1], begin[0] : end[0]]
        return bool(region.size) and float((region > 0.0).mean()) >= _MIN_KNOWN_RATIO


def find_covered_pixels(
    shape: tuple[int, ...], pipette: Pipette, tip: FloatArray, depth: float
) -> BoolArray:
    """Return which pixels (rows, columns) a pipette with its tip at ``tip`` (2,), px, darkens."""
    cosine, sine = np.cos(pipette.direction), np.sin(pipette.direction)
    right = np.arange(shape[1], dtype=np.float32) - float(tip[0])
    down = np.arange(shape[0], dtype=np.float32)[:, None] - float(tip[1])
    along, across = cosine * right + sine * down, np.abs(cosine * down - sine * right)
    distance = np.maximum(along, 0.0)
    blur = np.hypot(pipette.sharpest, pipette.defocus * (depth + pipette.depth_per_px * distance))
    half_width = (
        pipette.radius + pipette.taper * distance + _COVERED_BLUR_RATIO * blur + _COVERED_MARGIN_PX
    )
    return np.asarray((across <= half_width) & (along >= -half_width))
