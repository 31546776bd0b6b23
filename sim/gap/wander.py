"""A sensor that wanders: what is not white, goes on at rest, and follows from nothing."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray

_LATER_S = (0.02, 0.1, 0.5)  # over which a wander is told from a fixed offset
_LEAST_PAIRS = 50
_AT_REST = 0.3  # of the wander of all times, that rest has at least
_WHITE = 0.4  # of what is left, that is white at most
_STANDS_OUT = 1.15  # times what is white, of a change that is more
_ROUGH = 1.6  # exponent of time, with which a wander's squared change grows at most; motion: 2


@dataclass(frozen=True, slots=True)
class Wander:
    """What is left of a record, as far as it is not white.

    ``power`` is over the floor; ``at_rest`` tells whether it goes on at rest as a wander does,
    None where no rest was recorded that could tell.
    """

    power: float
    at_rest: bool | None


def wandering(time_s: FloatArray, left: FloatArray, resting: BoolArray) -> Wander | None:
    """Return what of a residual (n,) over the floor may be a wander; None where it is white.

    Random walks and 1/f noise change by as much at rest, where nothing else moves a reading, and
    by less than in proportion to time.
    """
    power = float(np.mean(left**2))
    white = float(np.mean(np.diff(left) ** 2)) / 2.0
    if white > _WHITE * power:
        return None
    return Wander(max(power - max(white, 1.0), 0.0), _goes_on(time_s, left, resting, white))


def _goes_on(time_s: FloatArray, left: FloatArray, resting: BoolArray, white: float) -> bool | None:
    period_s = float(np.median(np.diff(time_s)))
    rested = np.concatenate([[0], np.cumsum(~resting)])
    shares, grown = [], []
    still_white: float | None = None
    for later_s in (0.0, *_LATER_S):
        rows = max(round(later_s / period_s), 1 if later_s == 0.0 else 2)
        if rows >= len(left):
            break
        change = (left[rows:] - left[:-rows]) ** 2
        at_rest = rested[rows + 1 :] == rested[: -rows - 1]
        if at_rest.sum() < _LEAST_PAIRS:
            break
        there = float(change[at_rest].mean())
        if still_white is None:
            still_white = there / 2.0
            continue
        then = there - 2.0 * still_white
        if then > 2.0 * (_STANDS_OUT - 1.0) * still_white:
            shares.append(then / max(float(change.mean()) - 2.0 * white, 1e-300))
            grown.append((rows, then))
    if not shares:
        return None if still_white is None else False
    return float(np.exp(np.mean(np.log(shares)))) >= _AT_REST and not _is_smooth(grown)


def _is_smooth(grown: Sequence[tuple[int, float]]) -> bool:
    """Tell whether a squared change grows with time, from some time on, as that of a motion."""
    return any(
        float(np.log(large / small) / np.log(last / first)) > _ROUGH
        for (first, small), (last, large) in pairwise(grown)
    )
