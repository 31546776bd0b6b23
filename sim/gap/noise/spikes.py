"""Readings that leave the signal for a moment and return: spikes and dropouts of a sensor.

A dropout reads a fixed value such as zero, or repeats the last value while the axis moves.
"""

import numpy as np
from scipy.ndimage import median_filter

from rotemina.sim.arrays import BoolArray, FloatArray

_WINDOWS = (5, 41)  # rows over which a reading is expected to be like its neighbours
_FAR = 8.0  # robust standard deviations, and floors, from which a reading stands out
_BACK = 0.3  # of an excursion's size, within which it comes back to where it left
_NOTHING_ELSE = 0.15  # of an excursion's size, by which the rows beside it differ
_ABRUPT = 0.5  # of an excursion's size, that it does from one row to the next
_NEAR_A_STEP = 0.2  # of an excursion's size: a command that moved as far shortly before explains it
_SHORTLY_S = 0.15
_MOST = 0.05  # of the rows: what is more frequent is no exception
_STILL_ROWS = 3
_LEAPING = 0.2  # of the times that a reading stood still: a slip of friction is none
_STILL = 4.0  # floors that a reading is off at most where it stands still, but for noise
_DEVIATION = 1.4826  # standard deviations in a median absolute one


def excursions(
    time_s: FloatArray,
    gap: FloatArray,
    reading: FloatArray,
    change: FloatArray,
    *,
    sure: bool = False,
) -> BoolArray:
    """Return the rows (n,) that are outliers of a gap over its floor.

    They stand out from their neighbours, start and end abruptly, and no ``change`` (n,) of commands
    from row to row, in floors, came shortly before; or the ``reading`` (n,), in floors, is constant
    while the axis moves. If more than a twentieth of the rows would be outliers, none is one. If it
    is ``sure`` that no motion starts and ends like that, because the gap is relative to a
    reference, which rings as well, or occurs at rest, a single row that stands out is an outlier
    regardless of the command.
    """
    found = _away(time_s, gap, change, sure) | _held(gap, reading)
    return found if found.mean() <= _MOST else np.zeros(len(gap), dtype=np.bool_)


def _away(time_s: FloatArray, gap: FloatArray, change: FloatArray, sure: bool) -> BoolArray:
    out = np.zeros(len(gap), dtype=np.bool_)
    for window in _WINDOWS:
        if window < len(gap):
            out |= _standing_out(gap, window)
    found = np.zeros(len(gap), dtype=np.bool_)
    stepped = _recent_step(time_s, change)
    for begin, end in _runs(out):
        before, after, own = gap[begin - 1], gap[end], gap[begin:end]
        size = float(np.abs(own - (before + after) / 2.0).max())
        abrupt = min(abs(own[0] - before), abs(own[-1] - after)) > _ABRUPT * size
        back = abs(after - before) < _BACK * size
        alone = sure and end - begin == 1 and abs(after - before) < _NOTHING_ELSE * size
        if abrupt and back and (alone or stepped[begin] < _NEAR_A_STEP * size):
            found[begin:end] = True
    return found


def _held(gap: FloatArray, reading: FloatArray) -> BoolArray:
    """Return where (n,) a reading is constant and then often jumps to the expected value."""
    found = np.zeros(len(gap), dtype=np.bool_)
    leaps = total = 0
    for seen, until in _runs(_standing_out(gap, _WINDOWS[-1])):
        still = np.abs(reading - np.median(reading[seen:until])) <= _STILL
        begin = seen - int(np.argmin(still[seen::-1])) + 1
        end = seen + int(np.argmin(still[seen:]))
        if found[seen] or begin < 2 or end < until or end - begin < _STILL_ROWS:
            continue
        own, after = gap[begin:end], gap[end]
        size = float(np.abs(own - after).max())
        if abs(after - gap[begin - 1]) < _BACK * size:
            # The axis may have rested first, as the model does.
            found[begin + int(np.argmax(np.abs(own - after) > _FAR)) : end] = True
            leaps += abs(own[-1] - after) > _BACK * size
            total += 1
    return found if leaps > _LEAPING * total else np.zeros(len(gap), dtype=np.bool_)


def _runs(rows: BoolArray) -> list[tuple[int, int]]:
    """Return begin and end of each run of rows (n,), except at either end of a record."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], rows, [False]]).astype(np.int8)))
    inner = [(int(begin), int(end)) for begin, end in zip(edges[::2], edges[1::2], strict=True)]
    return [(begin, end) for begin, end in inner if begin > 0 and end < len(rows)]


def _spread(aside: FloatArray) -> float:
    return _DEVIATION * float(np.median(np.abs(aside)))


def _standing_out(gap: FloatArray, window: int) -> BoolArray:
    aside = gap - median_filter(gap, window, mode="nearest")
    return np.asarray(np.abs(aside) > _FAR * max(_spread(aside), 1.0))


def _recent_step(time_s: FloatArray, change: FloatArray) -> FloatArray:
    """Return how far (n,) commands went at most from row to row in the last moments."""
    rows = max(int(_SHORTLY_S / max(float(np.median(np.diff(time_s))), 1e-9)), 1)
    padded = np.concatenate([np.zeros(rows - 1), change])
    return np.asarray(np.lib.stride_tricks.sliding_window_view(padded, rows).max(axis=1))
