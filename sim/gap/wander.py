"""A sensor that wanders: what is slow, goes on at rest, and follows from nothing."""

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray

_SMOOTH_S = 0.1
_LATER_S = 0.5  # over which a wander is told from a fixed offset
_LEAST_PAIRS = 50
_AT_REST = 0.3  # of the wander of all times, that rest has at least
_SLOW = 0.85  # of what is left, that is slow at least


def wandering(time_s: FloatArray, left: FloatArray, resting: BoolArray) -> float | None:
    """Return the power of the slow wander in what is left (n,) over the floor, if there is one.

    None where it is not slow, or not there at rest, where nothing else moves a reading; and where
    no rest was recorded, as slow errors of the model look alike then.
    """
    period_s = float(np.median(np.diff(time_s)))
    window = max(int(_SMOOTH_S / period_s), 1)
    smooth = np.convolve(left, np.full(window, 1.0 / window), mode="same")
    power = float(np.mean(smooth**2)) - 1.0 / window
    if power < _SLOW * (float(np.mean(left**2)) - 1.0):
        return None
    later = max(int(_LATER_S / period_s), 1)
    if later >= len(left):
        return None
    change = (smooth[later:] - smooth[:-later]) ** 2
    rested = np.concatenate([[0], np.cumsum(~resting)])
    at_rest = rested[later + 1 :] == rested[: -later - 1]
    if at_rest.sum() < _LEAST_PAIRS:
        return None
    return power if float(change[at_rest].mean()) > _AT_REST * float(change.mean()) else None
