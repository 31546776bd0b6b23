"""The strongest line in the spectrum of what a model leaves, over position or over time."""

import numpy as np
from scipy.signal import detrend

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.records.record import Tap

_MOST_BINS = 1 << 17
_PADDED = 4  # lines per resolvable one
_EVERY = 3  # rows, of which one will do
_ABOUT = 1.6  # times the likeliest period, or a part of it, within which one is looked for
_MOST_TRIES = 600
_FINE = 12  # periods on either side, that are tried
_SHIFTS = 12
_PER_PERIOD = 4  # bins of position in the shortest period


def strongest_periods(
    evidence: Evidence, residual: FloatArray, bounds: tuple[float, float]
) -> list[float]:
    """Return the periods over position, within bounds, of the strongest line of each record.

    Over the commanded position, which the true one follows closely enough; strongest first.
    """
    lines = []
    for part in evidence.parts:
        if part.tap is not Tap.U:
            place = evidence.observations[part.record].record.signal(evidence.axis, Tap.CMD)
            line = _over_position(place, residual[part.rows], bounds)
            if line is not None:
                lines.append(line)
    return [period for period, _ in sorted(lines, key=lambda line: -line[1])]


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


def likeliest_steps(
    evidence: Evidence, residual: FloatArray, bounds: tuple[float, float], origin: float
) -> tuple[float, float] | None:
    """Return period and shift, in periods from ``origin``, of the sawtooth nearest a residual.

    Searched for where the scatter of a residual would have it, √12 times its rms, on the record
    of the shortest way, and then finely on all of them: a sawtooth of many teeth is soon out of
    step. None where nothing moves.
    """
    ways = []
    for part in evidence.parts:
        if part.tap is not Tap.U:
            observation = evidence.observations[part.record]
            place = observation.record.signal(evidence.axis, Tap.CMD) - origin
            gap = residual[part.rows]
            period = np.sqrt(12.0) * float(np.std(gap)) * observation.floor[part.tap]
            if np.ptp(place) > period > 0.0:
                ways.append((place[::_EVERY], gap[::_EVERY], period))
    if not ways:
        return None
    place, gap, likely = min(ways, key=lambda way: float(np.ptp(way[0])) / way[2])
    step = min(likely / float(np.ptp(place)) / 2.0, 0.05)
    count = min(int(2.0 * np.log(_ABOUT) / step), _MOST_TRIES)
    coarse = likely * np.geomspace(1.0 / _ABOUT, _ABOUT, count + 1)
    period = _best(place, gap, coarse)[0]
    every = [np.concatenate(arrays) for arrays in zip(*((w[0], w[1]) for w in ways), strict=True)]
    for wider in sorted({float(np.ptp(way[0])) for way in ways}):
        fine = 1.0 + np.linspace(-1.0, 1.0, 2 * _FINE + 1) * period / wider
        own = [way for way in ways if np.ptp(way[0]) <= wider]
        together = [np.concatenate([way[k] for way in own]) for k in (0, 1)]
        period = _best(together[0], together[1], period * fine)[0]
    period, shift = _best(every[0], every[1], np.array([period]))
    return float(np.clip(period, *bounds)), shift


def _best(place: FloatArray, gap: FloatArray, periods: FloatArray) -> tuple[float, float]:
    tried = [(float(p), k / _SHIFTS - 0.5) for p in periods for k in range(_SHIFTS)]
    return max(tried, key=lambda one: _likeness(place, gap, *one))


def _likeness(place: FloatArray, gap: FloatArray, period: float, shift: float) -> float:
    """Return how much of a gap (n,) a sawtooth over place (n,) takes away."""
    turns = place / period - shift
    teeth = np.rint(turns) - turns
    teeth = teeth - teeth.mean()
    return float(max(teeth @ gap, 0.0) ** 2 / (teeth @ teeth + 1e-30))


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
