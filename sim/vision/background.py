"""What a camera sees without the pipette, put together while the pipette is elsewhere."""

from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.vision.image import Image
from rotemina.sim.vision.pipette import Pipette

_BLURS = 4.0  # beyond its half width, where a body takes no light any more
_MARGIN_PX = 4.0
_LONGEST = 8.0  # pictures that the mean goes by: what changes slowly is followed
_LEAST_SEEN = 0.995  # of a part that is to be divided by it


@dataclass(frozen=True, slots=True, eq=False)
class Ground:
    """A background and where it is known.

    Attributes
    ----------
    image : (rows, columns)
        Mean brightness; without meaning where nothing was seen.
    pictures : (rows, columns)
        How many it is the mean of, up to a few.
    """

    image: Image
    pictures: Image

    @classmethod
    def empty(cls, shape: tuple[int, int]) -> Self:
        """Return one of which nothing is known yet."""
        return cls(np.zeros(shape, np.float32), np.zeros(shape, np.float32))

    def seen(
        self, image: NDArray[Any], pipette: Pipette, tip: FloatArray, depth: float
    ) -> "Ground":
        """Return it after one more picture (rows, columns), without what the pipette covers."""
        free = ~covered(image.shape, pipette, tip, depth)
        pictures = np.where(free, np.minimum(self.pictures + 1.0, _LONGEST), self.pictures)
        share = np.where(free, 1.0 / np.maximum(pictures, 1.0), 0.0).astype(np.float32)
        news = np.asarray(image, dtype=np.float32) - self.image
        return Ground(self.image + share * news, np.asarray(pictures, dtype=np.float32))

    def known(self, low: FloatArray, high: FloatArray) -> bool:
        """Return whether it is known from column and row ``low`` (2,) to ``high`` (2,)."""
        begin = np.maximum(np.floor(low), 0).astype(int)
        end = np.minimum(np.ceil(high), self.image.shape[::-1]).astype(int)
        part = self.pictures[begin[1] : end[1], begin[0] : end[0]]
        return bool(part.size) and float((part > 0.0).mean()) >= _LEAST_SEEN


def covered(shape: tuple[int, ...], pipette: Pipette, tip: FloatArray, depth: float) -> BoolArray:
    """Return which pixels (rows, columns) a pipette darkens whose tip is at ``tip`` (2,), px."""
    cosine, sine = np.cos(pipette.direction), np.sin(pipette.direction)
    right = np.arange(shape[1], dtype=np.float32) - float(tip[0])
    down = np.arange(shape[0], dtype=np.float32)[:, None] - float(tip[1])
    along, across = cosine * right + sine * down, np.abs(cosine * down - sine * right)
    inside = np.maximum(along, 0.0)
    blur = np.hypot(pipette.sharpest, pipette.defocus * (depth + pipette.climb * inside))
    reach = pipette.radius + pipette.taper * inside + _BLURS * blur + _MARGIN_PX
    return np.asarray((across <= reach) & (along >= -reach))
