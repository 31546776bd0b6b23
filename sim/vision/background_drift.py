"""Drift of the background between two pictures.

The picture is registered in tiles. Some tiles contain moving objects, such as the pipette, or too
little detail. The drift is the shift on which most tiles agree.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import RegistrationError
from rotemina.sim.vision.image import Image
from rotemina.sim.vision.registration import register_images

# Number of tiles down and across.
_TILE_COUNTS = (3, 4)
# Largest difference of the shifts of two tiles that agree.
_MAX_DISAGREEMENT_PX = 0.5
_MIN_AGREEING_TILES = 3


@dataclass(frozen=True, slots=True, eq=False)
class BackgroundDrift:
    """Shift of the background between two pictures.

    Attributes
    ----------
    shift : (2,)
        Columns and rows, px.
    covariance : (2, 2)
        Covariance of ``shift``, px², from the differences between the tiles that agree.
    agreeing, usable, tiles : int
        Number of tiles that agree, of tiles with enough detail, and of all tiles.
    """

    shift: FloatArray
    covariance: FloatArray
    agreeing: int
    usable: int
    tiles: int


def measure_background_drift(reference: Image, image: Image) -> BackgroundDrift:
    """Return the shift of the background of ``image`` relative to ``reference``.

    Raises
    ------
    RegistrationError
        If the images differ in size, fewer than three tiles agree, or fewer than half of the tiles
        with enough detail agree.
    """
    if reference.shape != image.shape:
        # This call raises the error for images that differ in size.
        register_images(reference, image)
    row_bounds, column_bounds = (
        np.linspace(0, size, tile_count + 1).astype(int)
        for size, tile_count in zip(image.shape, _TILE_COUNTS, strict=True)
    )
    shifts = []
    for top, bottom in pairwise(row_bounds):
        for left, right in pairwise(column_bounds):
            tile = slice(top, bottom), slice(left, right)
            try:
                shifts.append(register_images(reference[tile], image[tile]).shift)
            except RegistrationError:
                continue
    count = _TILE_COUNTS[0] * _TILE_COUNTS[1]
    tile_shifts = np.array(shifts).reshape(-1, 2)
    is_agreeing = np.zeros((0, 0), dtype=bool)
    if len(tile_shifts):
        is_agreeing = (
            np.linalg.norm(tile_shifts[:, None] - tile_shifts[None], axis=-1)
            <= _MAX_DISAGREEMENT_PX
        )
    agreeing_count = int(is_agreeing.sum(axis=0).max(initial=0))
    if agreeing_count < max(_MIN_AGREEING_TILES, len(tile_shifts) / 2.0):
        raise RegistrationError(
            "drift: {most} of {count} parts of the picture agree on a shift, must be at "
            "least {least} and half of the {seen} with enough detail; bring a background "
            "with detail into view and focus",
            most=agreeing_count,
            count=count,
            least=_MIN_AGREEING_TILES,
            seen=len(tile_shifts),
        )
    agreeing_shifts = tile_shifts[is_agreeing[int(np.argmax(is_agreeing.sum(axis=0)))]]
    covariance = np.cov(agreeing_shifts.T) / len(agreeing_shifts)
    return BackgroundDrift(
        agreeing_shifts.mean(axis=0), covariance, len(agreeing_shifts), len(tile_shifts), count
    )
