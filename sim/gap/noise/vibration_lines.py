"""Vibration: lines in the spectrum of a gap that are locked to time, regardless of the motion."""

import numpy as np
from scipy.signal import detrend

from rotemina.sim.arrays import BoolArray, FloatArray

_LINES = 4  # that are looked for
_WINDOW_S = 2.0  # over which amplitude and phase of a vibration may wander
_SLOWEST_HZ = 4.0  # below, commands have lines of their own
_STANDS_OUT = 30.0  # times the spectrum around it
_AROUND = 40  # lines on either side
_EVEN = 0.3  # of the strongest window's amplitude, that the median one has at least
_LEAST = 0.4  # floors, of a tone that matters


def tones(time_s: FloatArray, gap: FloatArray, resting: BoolArray) -> list[float]:
    """Return frequencies of lines in a gap (n,) over its floor that are there all the time.

    Strongest first. Where the axis rests (n,) they must be as strong as anywhere.
    """
    period_s = float(time_s[-1] - time_s[0]) / max(len(time_s) - 1, 1)
    left = np.asarray(detrend(gap))
    found: list[float] = []
    for _ in range(_LINES):
        line = _line(left, period_s)
        if line is None:
            break
        columns = tone_signals(time_s, [line])
        weights = np.linalg.lstsq(columns, left, rcond=None)[0]
        amplitude = np.hypot(weights[::2], weights[1::2])
        told = columns @ weights
        if not _steady(amplitude, told, resting):
            break
        found.append(line)
        left = left - told
    return found


def tone_signals(time_s: FloatArray, frequencies: list[float]) -> FloatArray:
    """Return signals (n, m) of tones whose amplitude and phase wander from second to second."""
    since = time_s - time_s[0]
    count = max(int(np.ceil(since[-1] / _WINDOW_S)), 1)
    knots = np.linspace(0.0, since[-1], count + 1)
    columns = []
    for knot in range(count + 1):
        # Hats that add up to one: a tone that does not wander is among them.
        weight = np.interp(since, knots, np.eye(count + 1)[knot])
        for frequency in frequencies:
            turn = 2.0 * np.pi * frequency * since
            columns += [weight * np.sin(turn), weight * np.cos(turn)]
    return np.stack(columns, axis=1)


def _line(gap: FloatArray, period_s: float) -> float | None:
    window = np.hanning(len(gap))
    power = np.abs(np.fft.rfft(gap * window, 2 * len(gap))) ** 2
    rates = np.fft.rfftfreq(2 * len(gap), period_s)
    power[rates < _SLOWEST_HZ] = 0.0
    best = int(np.argmax(power))
    around = np.concatenate(
        [power[max(best - _AROUND, 0) : max(best - 6, 0)], power[best + 7 : best + _AROUND]]
    )
    around = around[around > 0.0]
    amplitude = 2.0 * np.sqrt(power[best]) / window.sum()
    if not len(around) or power[best] < _STANDS_OUT * float(np.median(around)):
        return None
    return float(rates[best]) if amplitude > _LEAST else None


def _steady(amplitude: FloatArray, told: FloatArray, resting: BoolArray) -> bool:
    """Tell whether a tone is there all the time, at rest as well."""
    if float(np.median(amplitude)) < _EVEN * float(amplitude.max()):
        return False
    if resting.sum() < 100:
        return True
    return float(np.std(told[resting])) > _EVEN * float(np.std(told))
