"""In which frequencies a gap lies: a signal split into bands that add up to it."""

from collections.abc import Sequence

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.records.record import Record

_HALF_DECADES = (1.0, 3.0)  # bands begin at these parts of each decade
_EVEN = 1e-3  # relative spread of sample intervals up to which a record counts as evenly sampled
_LEAST_ROWS = 64


def band_edges(records: Sequence[Record]) -> FloatArray:
    """Return edges at 1, 3, 10, … Hz that hold every record's lowest and highest frequency."""
    lowest = min(1.0 / one.duration_s for one in records)
    highest = max(0.5 * (len(one.time_s) - 1) / one.duration_s for one in records)
    decades = range(int(np.floor(np.log10(lowest))), int(np.ceil(np.log10(highest))) + 1)
    steps = np.array([part * 10.0**decade for decade in decades for part in _HALF_DECADES])
    first = max(int(np.searchsorted(steps, lowest, side="right")) - 1, 0)
    last = int(np.searchsorted(steps, highest, side="left"))
    return steps[first : last + 1]


def bands(time_s: FloatArray, signal: FloatArray, edges_hz: FloatArray) -> FloatArray:
    """Split a signal (n,) into bands (b, n) that add up to it, by its cosine transform.

    The transform mirrors the signal at its ends, so drift does not leak into every band. Content
    below the first edge or above the last one counts to the nearest band.
    """
    from scipy.fft import dct, idct  # takes its time to import

    place = _band_of_lines(time_s, edges_hz)
    lines = dct(signal, norm="ortho")
    split = np.where(place == np.arange(len(edges_hz) - 1)[:, None], lines, 0.0)
    return np.asarray(idct(split, norm="ortho", axis=1))


def white_shares(time_s: FloatArray, edges_hz: FloatArray) -> FloatArray:
    """Return the share (b,) of white noise that lies in each band."""
    place = _band_of_lines(time_s, edges_hz)
    return np.bincount(place, minlength=len(edges_hz) - 1) / len(time_s)


def is_even(record: Record) -> bool:
    """Tell whether a record is sampled evenly, and long enough, to be split into bands."""
    intervals = np.diff(record.time_s)
    if len(intervals) < _LEAST_ROWS:
        return False
    return float(np.ptp(intervals)) <= _EVEN * float(intervals.mean())


def _band_of_lines(time_s: FloatArray, edges_hz: FloatArray) -> np.ndarray:
    """Return the band (n,) of each line of the cosine transform of n samples."""
    count = len(time_s)
    rate_hz = (count - 1) / float(time_s[-1] - time_s[0])
    frequency_hz = np.arange(count) * rate_hz / (2.0 * count)
    return np.searchsorted(edges_hz[1:-1], frequency_hz, side="right")
