"""Readings in steps coarser than the sensor's declared ones."""

import numpy as np

from rotemina.sim.arrays import FloatArray

_LEAST_STEP = 1.8  # declared resolutions, or floors, of a step that is a coarser one
_MOST_BINS = 1 << 19
_BINS_A_STEP = 8
_COHERENT = 0.5  # from which readings stand on a grid; independent ones come to 1/√n
_ALL = 0.62  # the same where all readings do, rounded to a third of the step
_PADDED = 4  # so that no grid falls between two lines
_NEARLY = 0.9
_SLACK = 0.15
_NEAR = 0.02  # relative difference of steps that are one
_FEWER = 0.7  # times as many different readings as expected, that a coarser sensor gives at most


def coarse_step(reading: FloatArray, expected: FloatArray, finest: float) -> float | None:
    """Return the step of a grid that matches a reading (n,) but not the expected reading.

    ``finest`` is the smallest step that counts. The characteristic function of the readings is one
    at multiples of 1/step (Widrow and Kollár, Quantization Noise, 2008, ch. 4).
    """
    if len(np.unique(reading)) > _FEWER * len(np.unique(expected)):
        return None  # noise fills in what lies between
    return _grid(reading, expected, finest, _COHERENT)


def stands_on(reading: FloatArray, expected: FloatArray, finest: float, step: float) -> bool:
    """Tell whether a reading (n,) lies on a grid of a known step, but the expected one does not.

    Repeated values are not required: a moving axis is read everywhere. An axis that moves in steps
    itself lies on the grid only at rest, unlike the grid of a sensor.
    """
    return _grid(reading, expected, finest, _ALL, step) is not None


def _grid(
    reading: FloatArray,
    expected: FloatArray,
    finest: float,
    coherent: float,
    near: float | None = None,
) -> float | None:
    finest *= _LEAST_STEP
    low = min(reading.min(), expected.min())
    span = max(reading.max(), expected.max()) - low  # of both: a model may lead far away
    width = max(finest / _BINS_A_STEP, span / _MOST_BINS)
    if np.ptp(reading) < 3.0 * finest or not width <= finest / 3.0:
        return None
    bins = int(np.ceil(span / width)) + 1
    own, other = (_characteristic(s - low, width, bins) for s in (reading, expected))
    rates = np.fft.rfftfreq(_PADDED * bins, width)
    # A hold of a whole record would stand on any grid.
    within = (rates > 3.0 / np.ptp(reading)) & (rates < 1.0 / finest)
    if near is not None:
        within &= np.abs(rates * near - 1.0) < _NEAR
    excess = np.where(within, own - other, 0.0)
    # A grid is one of its halves and thirds, too: the widest counts.
    best = int(np.argmax(excess > _NEARLY * excess.max()))
    if own[best] < coherent or excess[best] < _COHERENT - _SLACK:
        return None
    return float(1.0 / rates[best])


def _characteristic(reading: FloatArray, width: float, bins: int) -> FloatArray:
    """Return how well (rates,) readings match a grid of each rate: 1 if all lie on it."""
    counts = np.bincount((reading / width).astype(np.int64), minlength=bins)
    return np.asarray(np.abs(np.fft.rfft(counts, _PADDED * bins)) / len(reading))
