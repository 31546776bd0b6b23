"""Spectra of signals, and downsampling of loops that keeps extremes. Does not use Qt."""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray

MAX_SEGMENT_SAMPLES = 2048
# A spectrum needs at least this many samples.
_MIN_SAMPLES = 64
# A longer step than this number of sample periods means that samples are missing.
_MIN_GAP_PERIODS = 1.5


class AmplitudeSpectrum(NamedTuple):
    """Amplitude spectral densities of several signals.

    Attributes
    ----------
    frequency_hz : (m,)
        Above 0.
    density : (m, signals)
        In the unit of the signals per √Hz.
    """

    frequency_hz: FloatArray
    density: FloatArray


def compute_spectrum(time_s: FloatArray, signals: FloatArray) -> AmplitudeSpectrum | None:
    """Return the spectra of signals (n, signals) by Welch's method, or None for too few samples.

    The segments have a Hann window and overlap by half. If samples are missing, only the latest
    section without missing samples is used. The spectrum of a signal that is not finite is NaN.
    """
    steps = np.diff(time_s)
    if len(steps) < _MIN_SAMPLES:
        return None
    period_s = float(np.median(steps))
    gaps = np.flatnonzero(steps > _MIN_GAP_PERIODS * period_s)
    first_row = int(gaps[-1]) + 1 if len(gaps) else 0
    signals = signals[first_row:]
    if len(signals) < _MIN_SAMPLES:
        return None
    # Imported only when needed, because the import takes half a second.
    from scipy.signal import welch

    segment_length = min(MAX_SEGMENT_SAMPLES, len(signals))
    with np.errstate(invalid="ignore"):
        frequency, power = welch(signals, 1.0 / period_s, nperseg=segment_length, axis=0)
    return AmplitudeSpectrum(frequency[1:], np.sqrt(power[1:]))


def thin_loop(x: FloatArray, y: FloatArray, buckets: int) -> tuple[FloatArray, FloatArray]:
    """Return at most ``4·buckets`` points of a curve, in order, that keep its extremes.

    Each bucket of adjacent samples keeps the points with the lowest and highest x and y, so that
    no tip of a loop and no spike is lost. A point that is extreme twice appears twice. A short
    curve is returned unchanged.
    """
    count = len(x)
    if count <= 4 * buckets:
        return x, y
    bucket_size = -(-count // buckets)
    full_count = count // bucket_size * bucket_size
    extremes = []
    for values in (x, y):
        blocks = values[:full_count].reshape(-1, bucket_size)
        extremes += [blocks.argmin(axis=1), blocks.argmax(axis=1)]
    rows_in_bucket = np.sort(np.stack(extremes, axis=1), axis=1)
    kept_rows = (rows_in_bucket + bucket_size * np.arange(len(rows_in_bucket))[:, None]).ravel()
    if full_count < count:
        last_bucket_rows = [
            full_count + find_extreme(values[full_count:])
            for values in (x, y)
            for find_extreme in (np.argmin, np.argmax)
        ]
        kept_rows = np.append(kept_rows, np.sort(last_bucket_rows))
    return x[kept_rows], y[kept_rows]
