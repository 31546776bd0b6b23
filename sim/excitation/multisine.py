"""Spectral lines and phases of a random-phase odd multisine."""

from math import ceil, floor

import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray

_MAX_ROUNDS = 200
# The total number of points over all rounds is limited, so many lines mean fewer rounds.
_MAX_TOTAL_POINTS = 40_000_000
# Clipping levels in the first and the last round, as fractions of the peak.
_FIRST_CLIP_RATIO, _LAST_CLIP_RATIO = 0.75, 0.95
_POINTS_PER_HIGHEST_PERIOD = 8
# A line that is outside the band by less than this still belongs to it.
_BAND_TOLERANCE = 1e-9


def choose_odd_lines(low: float, high: float, detection: int, rng: np.random.Generator) -> IntArray:
    """Return the odd harmonics from ``low`` to ``high`` (in harmonics), ascending.

    From each complete group of ``detection`` consecutive lines, one random line is omitted; 0 omits
    none.
    """
    first = max(1, ceil(low - _BAND_TOLERANCE))
    lines = np.arange(first + (first + 1) % 2, floor(high + _BAND_TOLERANCE) + 1, 2, dtype=np.int64)
    if detection == 0:
        return lines
    group_count = len(lines) // detection
    omitted = np.arange(group_count) * detection + rng.integers(detection, size=group_count)
    return np.delete(lines, omitted)


def reduce_crest(lines: IntArray, amplitudes: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Return phases (m,), rad, of lines (m,) with the given amplitudes, for a low crest factor.

    The phases are random at first. Each round clips the peaks of the signal and continues with the
    phases of the clipped signal (van der Ouderaa, Schoukens and Renneboog, IEEE Trans. Instrum.
    Meas. 37, 1988). The phases with the lowest peak are returned.
    """
    points = _POINTS_PER_HIGHEST_PERIOD * (int(lines[-1]) + 1)
    spectrum = np.zeros(points // 2 + 1, dtype=np.complex128)
    phase = rng.uniform(0.0, 2.0 * np.pi, len(lines))
    best_phase, lowest_peak = phase, np.inf
    rounds = min(_MAX_ROUNDS, max(10, _MAX_TOTAL_POINTS // points))
    for clip_ratio in np.linspace(_FIRST_CLIP_RATIO, _LAST_CLIP_RATIO, rounds):
        spectrum[lines] = amplitudes * np.exp(1j * phase)
        signal = np.fft.irfft(spectrum, n=points)
        peak = float(np.abs(signal).max())
        if peak < lowest_peak:
            best_phase, lowest_peak = phase, peak
        level = clip_ratio * peak
        phase = np.angle(np.fft.rfft(np.clip(signal, -level, level))[lines])
    return np.asarray(best_phase)


def rotate_to_quietest_start(period: FloatArray) -> FloatArray:
    """Return a period (n,), rotated so that it begins and ends as close to rest as possible.

    The rotation minimises the larger of the first and the last step.
    """
    step = np.abs(np.diff(period, append=period[0]))
    start = int(np.argmin(np.maximum(step, np.roll(step, 2))))
    return np.roll(period, -start)
