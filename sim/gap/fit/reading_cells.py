"""The exact information of a coarse reading: the step within which the axis was.

All answers inside the step are equally good; outside, an answer is off by its distance to the
nearer edge (bounded errors: Milanese and Vicino, Automatica 27 (1991) 997-1009).
"""

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray

_ONE = 0.1  # of a step, by which a change may differ from it
_ROUNDED = 3.6  # floors, by which it may differ where they come from rounding: √12
_SLOW = 0.5  # of a step, that the axis goes from row to row at most
_COARSE = 6.0  # floors of a step that is a cell: noise hardly reaches from edge to edge
_LEAST_EDGES = 20  # in a record, from which its steps are cells
_OFFSET_STEPS = 12
_OFFSET_FOUND = 1e-6  # of half a cell

# Noise σ takes a reading over an edge at a distance of t with P(n > t), and leaves t beyond it:
# (2/step) ∫ t² P(n > t) dt = 2 E[max(n, 0)³] / (3 step), with E[max(n, 0)³] = √(2/π) σ³.
_OVER_AN_EDGE = 2.0 / 3.0 * np.sqrt(2.0 / np.pi)


def cell_of(reading: FloatArray, expected: FloatArray, step: float, floor: float) -> float | None:
    """Return the width of the cells in which a reading (n,) locates an axis.

    All values are SI: ``step`` approximates that of the reading, ``expected`` (n,) is the reading
    without steps, and ``floor`` the rms of finer noise. None if a record crosses too few edges.
    """
    change = np.abs(np.diff(reading, prepend=reading[0]))
    pace = np.abs(np.diff(expected, prepend=expected[0]))
    off = min(max(_ONE * step, _ROUNDED * floor), 0.5 * step)
    edges = (np.abs(change - step) < off) & (pace < _SLOW * step)
    if step < _COARSE * floor or int(edges.sum()) < _LEAST_EDGES:
        return None
    return float(change[edges].mean())


def floor_beyond(floor: float, step: float) -> float:
    """Return the rms, SI, by which a true answer lies beyond cells of readings with noise.

    ``floor`` is the rms of that noise and ``step`` the width of the cells, SI.
    """
    return floor * float(np.sqrt(_OVER_AN_EDGE * floor / step))


def beyond(gap: FloatArray, half: float, kept: BoolArray | None) -> FloatArray:
    """Return how far (n,) a gap (n,) exceeds ``half`` a cell, for the best offset.

    All values are in floors, and 0 in rows that are not ``kept`` (n,). Newton's steps on the
    piecewise quadratic find the offset with the smallest remainder.
    """
    own = gap if kept is None else gap[kept]
    left = _outside(own, half)
    for _ in range(_OFFSET_STEPS):
        offset = float(left.sum()) / max(int(np.count_nonzero(left)), 1)
        own = own - offset
        left = _outside(own, half)
        if abs(offset) < _OFFSET_FOUND * half:
            break
    if kept is None:
        return left
    whole = np.zeros(len(gap))
    whole[kept] = left
    return whole


def _outside(gap: FloatArray, half: float) -> FloatArray:
    return np.asarray(gap - np.clip(gap, -half, half))
