"""The strongest line in the spectrum of what a model leaves, over position or over time."""

import numpy as np
from scipy.signal import detrend

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.records.record import Tap

_MOST_BINS = 1 << 17
_PADDED = 4  # lines per resolvable one
_EVERY = 3  # rows, of which one will do
_FINE = 12  # periods on either side, that are tried
_SHIFTS = 12
_PER_PERIOD = 4  # bins of position in the shortest period


def strongest_period(
    evidence: Evidence, residual: FloatArray, bounds: tuple[float, float]
) -> float | None:
    """Return the period over position, within bounds, of the strongest line; None without one.

    Over the commanded position, which the true one follows closely enough.
    """
    best: tuple[float, float] | None = None
    for part in evidence.parts:
        if part.tap is Tap.U:
            continue
        place = evidence.observations[part.record].record.signal(evidence.axis, Tap.CMD)
        line = _over_position(place, residual[part.rows], bounds)
        if line is not None and (best is None or line[1] > best[1]):
            best = line
    return best[0] if best is not None else None


def strongest_frequency(
    evidence: Evidence, residual: FloatArray, bounds: tuple[float, float]
) -> float | None:
    """Return the frequency over time, within bounds, of the strongest line; None without one."""
    best: tuple[float, float] | None = None
    for part in evidence.parts:
        time_s = evidence.observations[part.record].record.time_s
        period_s = float(time_s[-1] - time_s[0]) / max(len(time_s) - 1, 1)
        line = _peak(detrend(residual[part.rows]), period_s, bounds)
        if line is not None and (best is None or line[1] > best[1]):
            best = line
    return best[0] if best is not None else None


def steps_at(
    evidence: Evidence, residual: FloatArray, period: float, origin: float
) -> tuple[float, float]:
    """Return period and shift, in periods from ``origin``, of the sawtooth nearest a residual.

    A sawtooth of many teeth is out of step long before its line in a spectrum is.
    """
    places, gaps = [], []
    for part in evidence.parts:
        if part.tap is not Tap.U:
            record = evidence.observations[part.record].record
            places.append(record.signal(evidence.axis, Tap.CMD)[::_EVERY] - origin)
            gaps.append(residual[part.rows][::_EVERY])
    place, gap = np.concatenate(places), np.concatenate(gaps)
    reach = max(float(np.ptp(place)), period)
    fine = period * (1.0 + np.linspace(-1.0, 1.0, 2 * _FINE + 1) * period / reach)
    tried = [(float(p), k / _SHIFTS - 0.5) for p in fine for k in range(_SHIFTS)]
    return max(tried, key=lambda one: _likeness(place, gap, *one))


def _likeness(place: FloatArray, gap: FloatArray, period: float, shift: float) -> float:
    turns = place / period - shift
    return float((np.rint(turns) - turns) @ gap)


def _over_position(
    place: FloatArray, gap: FloatArray, bounds: tuple[float, float]
) -> tuple[float, float] | None:
    """Return period and power of the strongest line of ``gap`` over ``place``, both (n,)."""
    reach = float(np.ptp(place))
    if reach <= 2.0 * bounds[0]:
        return None
    width = max(min(bounds) / _PER_PERIOD, reach / _MOST_BINS, reach / len(place))
    bins = np.floor((place - place.min()) / width).astype(np.int64)
    visits = np.bincount(bins)
    mean = np.bincount(bins, gap) / np.maximum(visits, 1)
    # Each place counts once, however long the axis held there; slow trends are no lines.
    seen = visits > 0
    mean[seen] = detrend(mean[seen])
    peak = _peak(mean, width, (1.0 / bounds[1], 1.0 / bounds[0]))
    return None if peak is None else (1.0 / peak[0], peak[1])


def _peak(
    signal: FloatArray, step: float, bounds: tuple[float, float]
) -> tuple[float, float] | None:
    """Return rate and power of the strongest line of an evenly spaced signal (n,)."""
    power = np.abs(np.fft.rfft(signal, _PADDED * len(signal))) ** 2
    rates = np.fft.rfftfreq(_PADDED * len(signal), step)
    slowest = 1.5 / (step * len(signal))  # what hardly completes a period is a trend
    within = (rates >= max(bounds[0], slowest)) & (rates <= bounds[1])
    if not within.any():
        return None
    best = int(np.argmax(np.where(within, power, -1.0)))
    return float(rates[best]), float(power[best])
