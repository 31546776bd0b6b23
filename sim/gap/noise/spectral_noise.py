"""How much of a gap is noise: the level of its spectrum where nothing else is."""

from collections.abc import Sequence

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from scipy.signal import welch

from rotemina.sim.arrays import FloatArray

_SEGMENT_ROWS = 512
_MEDIAN = 0.6931  # of the power of a line of white noise, over its mean
_PIECES = 6  # of a record, of which the quietest tells of its noise
_BANDS = 4
_FLAT = 2.0  # of the second band over the last one
_LEAST_ROWS = 256
_SLOWEST = 0.1  # of all rows
_BEND = 3  # rows of a second difference


def noise_level(gap: FloatArray) -> float:
    """Return the rms of the white noise in a gap (n,), in its unit.

    It is the median over frequency of the spectrum of the quietest part: lines, slow motion and the
    command leave most frequencies unaffected most of the time.
    """
    pieces = np.array_split(gap, min(_PIECES, max(len(gap) // _LEAST_ROWS, 1)))
    return float(np.sqrt(min(_level(piece) for piece in pieces)))


def slow_level(gaps: Sequence[FloatArray], paces: Sequence[FloatArray]) -> float:
    """Return the rms of what changes from row to row where the axis is slowest, in the gaps' unit.

    There is no more noise than that: what grows with the pace comes with the motion. Both are
    (n,) for each record; infinite if all are too short to tell.
    """
    told = [(gap, pace) for gap, pace in zip(gaps, paces, strict=True) if len(gap) > _BEND]
    if not told:
        return np.inf
    bends = np.concatenate([np.diff(gap, 2) for gap, _ in told])
    pace = np.concatenate([sliding_window_view(own, _BEND).max(axis=1) for _, own in told])
    slow = pace <= np.quantile(pace, _SLOWEST)
    return float(np.sqrt(np.mean(bends[slow] ** 2) / 6.0))


def common_level(levels: Sequence[float]) -> float:
    """Return the noise level of most of some records, of two the lower; 0 where none tells.

    A sensor's noise is the same in all of them. What quick motion leaves from row to row may look
    like more.
    """
    told = sorted(level for level in levels if level > 0.0)
    return told[(len(told) - 1) // 2] if told else 0.0


def _level(gap: FloatArray) -> float:
    """Return the power of the white part: the lowest of the levels of several bands.

    0 if the spectrum falls even beyond slow motion, like that of a drift.
    """
    rows = min(_SEGMENT_ROWS, len(gap))
    _, power = welch(gap, nperseg=rows)
    segments = max(2 * len(gap) // rows - 1, 1)
    bias = _MEDIAN + (1.0 - _MEDIAN) * (1.0 - 1.0 / np.sqrt(segments))
    levels = [float(np.median(band)) for band in np.array_split(power[1:], _BANDS)]
    if levels[1] > _FLAT * levels[-1]:
        return 0.0
    return float(min(levels) / bias / 2.0)
