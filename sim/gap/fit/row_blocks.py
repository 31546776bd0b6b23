"""Blocks of rows that count as one observation, and intervals by block bootstrap.

Neighbouring samples of a gap are not independent: a hold is one observation at any sampling rate.
The bootstrap therefore draws whole blocks with replacement (Künsch, Annals of Statistics 17 (1989)
1217-1241).
"""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray

_BLOCK_S = 0.25  # of a path that keeps moving
_DRAWS = 1000


class Blocks(NamedTuple):
    """Sums over blocks: (b, c) of c quantities, and how many rows each block has, (b,)."""

    total: FloatArray
    rows: FloatArray


def block_numbers(time_s: FloatArray, command: FloatArray, *, cut_holds: bool = False) -> IntArray:
    """Return the block (n,) of each row: a hold is one, a moving path is cut every 0.25 s.

    With ``cut_holds`` holds are cut, too.
    """
    held = np.diff(command, append=command[-1]) == 0.0  # until the next row
    held &= not cut_holds
    moving = np.floor((time_s - time_s[0]) / _BLOCK_S)
    begins = np.ones(len(time_s), dtype=np.bool_)
    begins[1:] = (held[1:] != held[:-1]) | (~held[1:] & (moving[1:] != moving[:-1]))
    return np.asarray(np.cumsum(begins) - 1, dtype=np.int64)


def summed(numbers: IntArray, values: FloatArray) -> Blocks:
    """Sum ``values`` (n, c) over each block."""
    count = int(numbers.max()) + 1
    total = np.stack([np.bincount(numbers, column, count) for column in values.T], axis=1)
    return Blocks(
        np.asarray(total, dtype=np.float64),
        np.bincount(numbers, minlength=count).astype(np.float64),
    )


def drawn_means(blocks: Blocks, rng: np.random.Generator, draws: int = _DRAWS) -> FloatArray:
    """Return means (draws, c) over all rows, each of as many blocks drawn with replacement."""
    count = len(blocks.rows)
    chosen = rng.integers(0, count, size=(draws, count))
    times = np.stack([np.bincount(row, minlength=count) for row in chosen]).astype(np.float64)
    return np.asarray((times @ blocks.total) / (times @ blocks.rows)[:, None])
