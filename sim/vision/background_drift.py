"""How a background that should stand has moved between two pictures.

The picture is registered in tiles. What moves by itself, such as the pipette, and what shows too
little is in some of them; the drift is what most tiles agree on.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message
from rotemina.sim.vision.errors import RegistrationError
from rotemina.sim.vision.image import Image
from rotemina.sim.vision.registration import register

_TILES = (3, 4)  # down and across
_AGREE_PX = 0.5
_LEAST_AGREEING = 3


@dataclass(frozen=True, slots=True, eq=False)
class Drift:
    """By how much the background has moved.

    Attributes
    ----------
    shift : (2,)
        Columns and rows, px.
    covariance : (2, 2)
        px², from how much the tiles that agree differ.
    agreeing, seen, tiles : int
        How many tiles agree, show enough, and there are.
    """

    shift: FloatArray
    covariance: FloatArray
    agreeing: int
    seen: int
    tiles: int


def background_drift(reference: Image, image: Image) -> Drift:
    """Return by how much the background of ``image`` has moved since ``reference``.

    Raises
    ------
    RegistrationError
        If the images differ in size, or fewer than three tiles, or not half of those that show
        enough, agree.
    """
    if reference.shape != image.shape:
        register(reference, image)  # says what is wrong
    down, across = (
        np.linspace(0, n, k + 1).astype(int) for n, k in zip(image.shape, _TILES, strict=True)
    )
    shifts = []
    for top, bottom in pairwise(down):
        for left, right in pairwise(across):
            tile = slice(top, bottom), slice(left, right)
            try:
                shifts.append(register(reference[tile], image[tile]).shift)
            except RegistrationError:
                continue
    count = _TILES[0] * _TILES[1]
    seen = np.array(shifts).reshape(-1, 2)
    close = np.zeros((0, 0), dtype=bool)
    if len(seen):
        close = np.linalg.norm(seen[:, None] - seen[None], axis=-1) <= _AGREE_PX
    most = int(close.sum(axis=0).max(initial=0))
    if most < max(_LEAST_AGREEING, len(seen) / 2.0):
        raise RegistrationError(
            message(
                "engine",
                "drift: {most} of {count} parts of the picture agree on a shift, must be at "
                "least {least} and half of the {seen} with enough detail; bring a background "
                "with detail into view and focus",
            ).fill(most=most, count=count, least=_LEAST_AGREEING, seen=len(seen))
        )
    agreed = seen[close[int(np.argmax(close.sum(axis=0)))]]
    spread = np.cov(agreed.T) / len(agreed)
    return Drift(agreed.mean(axis=0), spread, len(agreed), len(seen), count)
