"""Readings in steps coarser than the sensor's declared ones."""

import numpy as np

from rotemina.sim.arrays import FloatArray

_LEAST_STEP = 1.8  # declared resolutions, or floors, of a step that is a coarser one
_MOST_BINS = 1 << 19
_BINS_A_STEP = 8
_COHERENT = 0.5  # from which readings stand on a grid; independent ones come to 1/√n
_SLACK = 0.15
_FEWER = 0.7  # times as many different readings as expected, that a coarser sensor gives at most


def coarse_step(reading: FloatArray, expected: FloatArray, finest: float) -> float | None:
    """Return the step of the grid on which a reading (n,) stands and the expected one does not.

    ``finest`` is the least step that counts. The characteristic function of the readings is one
    at multiples of 1/step (Widrow and Kollár, Quantization Noise, 2008, ch. 4).
    """
    if len(np.unique(reading)) > _FEWER * len(np.unique(expected)):
        return None  # noise fills in what lies between
    finest *= _LEAST_STEP
    width = max(finest / _BINS_A_STEP, np.ptp(reading) / _MOST_BINS)
    if np.ptp(reading) < 3.0 * finest or width > finest / 3.0:
        return None
    low = min(reading.min(), expected.min())
    bins = int(np.ceil((max(reading.max(), expected.max()) - low) / width)) + 1
    own, other = (
        np.abs(np.fft.rfft(np.bincount(((s - low) / width).astype(np.int64), minlength=bins)))
        / len(s)
        for s in (reading, expected)
    )
    rates = np.fft.rfftfreq(bins, width)
    # A hold of a whole record would stand on any grid.
    within = (rates > 3.0 / np.ptp(reading)) & (rates < 1.0 / finest)
    excess = np.where(within, own - other, 0.0)
    best = int(np.argmax(excess))
    if own[best] < _COHERENT or excess[best] < _COHERENT - _SLACK:
        return None
    return float(1.0 / rates[best])
