"""Decomposition of a signal into frequency bands whose sum is the signal."""

from collections.abc import Sequence

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.records import Record

# In each decade, bands begin at these multiples of the lower end of the decade.
_BAND_STARTS = (1.0, 3.0)
# A record counts as evenly sampled if the relative spread of its intervals is at most this.
_MAX_INTERVAL_SPREAD_RATIO = 1e-3
_MIN_ROWS = 64


def find_band_edges(records: Sequence[Record]) -> FloatArray:
    """Return edges at 1, 3, 10, … Hz that enclose the frequencies of all records."""
    lowest = min(1.0 / record.duration_s for record in records)
    highest = max(0.5 * (len(record.time_s) - 1) / record.duration_s for record in records)
    decades = range(int(np.floor(np.log10(lowest))), int(np.ceil(np.log10(highest))) + 1)
    candidate_edges = np.array(
        [multiple * 10.0**decade for decade in decades for multiple in _BAND_STARTS]
    )
    first = max(int(np.searchsorted(candidate_edges, lowest, side="right")) - 1, 0)
    last = int(np.searchsorted(candidate_edges, highest, side="left"))
    return candidate_edges[first : last + 1]


def split_into_bands(time_s: FloatArray, signal: FloatArray, edges_hz: FloatArray) -> FloatArray:
    """Split a signal (n,) into bands (b, n) whose sum is the signal, by a cosine transform.

    The transform mirrors the signal at its ends, so drift does not leak into all bands. Content
    below the first or above the last edge belongs to the nearest band.
    """
    # SciPy is slow to import, so it is imported only when needed.
    from scipy.fft import dct, idct

    line_bands = _find_line_bands(time_s, edges_hz)
    lines = dct(signal, norm="ortho")
    band_lines = np.where(line_bands == np.arange(len(edges_hz) - 1)[:, None], lines, 0.0)
    return np.asarray(idct(band_lines, norm="ortho", axis=1))


def compute_white_noise_shares(time_s: FloatArray, edges_hz: FloatArray) -> FloatArray:
    """Return the fraction (b,) of the power of white noise that lies in each band."""
    line_bands = _find_line_bands(time_s, edges_hz)
    return np.bincount(line_bands, minlength=len(edges_hz) - 1) / len(time_s)


def is_evenly_sampled(record: Record) -> bool:
    """Return whether a record is sampled evenly and is long enough to be split into bands."""
    intervals = np.diff(record.time_s)
    if len(intervals) < _MIN_ROWS:
        return False
    return float(np.ptp(intervals)) <= _MAX_INTERVAL_SPREAD_RATIO * float(intervals.mean())


def _find_line_bands(time_s: FloatArray, edges_hz: FloatArray) -> np.ndarray:
    """Return the band (n,) of each line of the cosine transform of n samples."""
    rows = len(time_s)
    rate_hz = (rows - 1) / float(time_s[-1] - time_s[0])
    frequency_hz = np.arange(rows) * rate_hz / (2.0 * rows)
    return np.searchsorted(edges_hz[1:-1], frequency_hz, side="right")
