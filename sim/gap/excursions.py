"""Readings that leave for a moment and come back: spikes and dropouts of a sensor."""

import numpy as np
from scipy.ndimage import median_filter

from rotemina.sim.arrays import BoolArray, FloatArray

_WINDOWS = (5, 41)  # rows over which a reading is expected to be like its neighbours
_FAR = 8.0  # robust standard deviations, and floors, from which a reading stands out
_BACK = 0.3  # of an excursion's size, within which it comes back to where it left
_ABRUPT = 0.5  # of an excursion's size, that it does from one row to the next
_NEAR_A_STEP = 0.2  # of an excursion's size: a command that moved as far shortly before explains it
_SHORTLY_S = 0.15
_MOST = 0.05  # of the rows: what is more frequent is no exception
_DEVIATION = 1.4826  # standard deviations in a median absolute one


def excursions(time_s: FloatArray, gap: FloatArray, command: FloatArray) -> BoolArray:
    """Return which rows (n,) are outliers of a gap over its floor.

    They stand out from their neighbours, come and go abruptly, and no step of the command (n,),
    in floors, came shortly before. Where more than a twentieth would be outliers, none is one.
    """
    out = np.zeros(len(gap), dtype=np.bool_)
    for window in _WINDOWS:
        if window < len(gap):
            out |= _standing_out(gap, window)
    found = np.zeros(len(gap), dtype=np.bool_)
    stepped = _recent_step(time_s, command)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], out, [False]]).astype(np.int8)))
    for begin, end in zip(edges[::2], edges[1::2], strict=True):
        if begin == 0 or end == len(gap):
            continue
        before, after, own = gap[begin - 1], gap[end], gap[begin:end]
        size = float(np.abs(own - (before + after) / 2.0).max())
        abrupt = min(abs(own[0] - before), abs(own[-1] - after)) > _ABRUPT * size
        back = abs(after - before) < _BACK * size
        if abrupt and back and stepped[begin] < _NEAR_A_STEP * size:
            found[begin:end] = True
    return found if found.mean() <= _MOST else np.zeros(len(gap), dtype=np.bool_)


def _standing_out(gap: FloatArray, window: int) -> BoolArray:
    aside = gap - median_filter(gap, window, mode="nearest")
    spread = _DEVIATION * float(np.median(np.abs(aside)))
    return np.asarray(np.abs(aside) > _FAR * max(spread, 1.0))


def _recent_step(time_s: FloatArray, command: FloatArray) -> FloatArray:
    """Return how far (n,) a command went at most from row to row in the last moments."""
    rows = max(int(_SHORTLY_S / max(float(np.median(np.diff(time_s))), 1e-9)), 1)
    change = np.abs(np.diff(command, prepend=command[0]))
    padded = np.concatenate([np.zeros(rows - 1), change])
    return np.asarray(np.lib.stride_tricks.sliding_window_view(padded, rows).max(axis=1))
