"""Spectra, and loops thinned without hiding extremes. Free of Qt."""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray

SEGMENT = 2048  # samples of one piece of a spectrum, at most
_LEAST = 64  # samples, below which there is no spectrum
_GAP = 1.5  # of the sample time, above which samples are missing


class Spectrum(NamedTuple):
    """Amplitude spectral densities (m, signals), per √Hz, at frequencies (m,), Hz, above 0."""

    frequency_hz: FloatArray
    density: FloatArray


def spectrum(time_s: FloatArray, signals: FloatArray) -> Spectrum | None:
    """Return the spectra of signals (n, signals) by Welch's method (Hann, half overlapped).

    Of samples with gaps the latest stretch without one counts. A signal that is not finite
    anywhere has NaN. None where there are too few samples.
    """
    steps = np.diff(time_s)
    if len(steps) < _LEAST:
        return None
    period_s = float(np.median(steps))
    gaps = np.flatnonzero(steps > _GAP * period_s)
    first = int(gaps[-1]) + 1 if len(gaps) else 0
    signals = signals[first:]
    if len(signals) < _LEAST:
        return None
    from scipy.signal import welch  # only here: it takes half a second

    length = min(SEGMENT, len(signals))
    with np.errstate(invalid="ignore"):
        frequency, power = welch(signals, 1.0 / period_s, nperseg=length, axis=0)
    return Spectrum(frequency[1:], np.sqrt(power[1:]))


def thinned_loop(x: FloatArray, y: FloatArray, buckets: int) -> tuple[FloatArray, FloatArray]:
    """Return at most ``4·buckets`` points of a curve, in order, that keep its extremes.

    Of each run of neighbouring samples the points with the lowest and highest x and y stay, so
    that no tip of a loop and no spike is lost; one that is extreme twice comes twice. A short curve
    comes back as it is.
    """
    count = len(x)
    if count <= 4 * buckets:
        return x, y
    size = -(-count // buckets)
    whole = count // size * size
    found = []
    for values in (x, y):
        blocks = values[:whole].reshape(-1, size)
        found += [blocks.argmin(axis=1), blocks.argmax(axis=1)]
    rows = np.sort(np.stack(found, axis=1), axis=1)
    index = (rows + size * np.arange(len(rows))[:, None]).ravel()
    if whole < count:
        rest = [whole + at(part[whole:]) for part in (x, y) for at in (np.argmin, np.argmax)]
        index = np.append(index, np.sort(rest))
    return x[index], y[index]
