"""Lines and phases of a random-phase odd multisine."""

from math import ceil, floor

import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray

_ROUNDS = 200
_POINTS = 40_000_000  # of all rounds together: fewer rounds where there are many lines
_FIRST_CLIP, _LAST_CLIP = 0.75, 0.95  # of the peak
_OVERSAMPLING = 8  # grid points per period of the highest line
_SLACK = 1e-9  # a band that ends this near a line has it


def odd_lines(low: float, high: float, detection: int, rng: np.random.Generator) -> IntArray:
    """Return the odd harmonics between ``low`` and ``high`` (in harmonics), ascending.

    Of each whole group of ``detection`` consecutive ones, one drawn by lot is left out; 0 keeps
    all.
    """
    first = max(1, ceil(low - _SLACK))
    lines = np.arange(first + (first + 1) % 2, floor(high + _SLACK) + 1, 2, dtype=np.int64)
    if detection == 0:
        return lines
    groups = len(lines) // detection
    left_out = np.arange(groups) * detection + rng.integers(detection, size=groups)
    return np.delete(lines, left_out)


def reduced_crest(lines: IntArray, size: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Return phases (m,), rad, of lines (m,) of amplitudes ``size`` with a low crest factor.

    From random phases, the signal's peaks are clipped again and again and the phases of what is
    left are kept (van der Ouderaa, Schoukens and Renneboog, IEEE Trans. Instrum. Meas. 37, 1988);
    the best found is returned.
    """
    points = _OVERSAMPLING * (int(lines[-1]) + 1)
    spectrum = np.zeros(points // 2 + 1, dtype=np.complex128)
    phase = rng.uniform(0.0, 2.0 * np.pi, len(lines))
    best, lowest = phase, np.inf
    rounds = min(_ROUNDS, max(10, _POINTS // points))
    for clip in np.linspace(_FIRST_CLIP, _LAST_CLIP, rounds):
        spectrum[lines] = size * np.exp(1j * phase)
        signal = np.fft.irfft(spectrum, n=points)
        peak = float(np.abs(signal).max())
        if peak < lowest:
            best, lowest = phase, peak
        level = clip * peak
        phase = np.angle(np.fft.rfft(np.clip(signal, -level, level))[lines])
    return np.asarray(best)


def quietest_start(period: FloatArray) -> FloatArray:
    """Return a period (n,) rolled so that it begins, and ends, as near to rest as it can.

    Its first step, and the last one inside the period, are then the smallest of all such pairs.
    """
    step = np.abs(np.diff(period, append=period[0]))
    start = int(np.argmin(np.maximum(step, np.roll(step, 2))))
    return np.roll(period, -start)
