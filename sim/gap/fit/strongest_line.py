"""The strongest line in the spectrum of a remainder, over position or over time."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.fit.output_error import Fit
from rotemina.sim.records import Tap

_MOST_BINS = 1 << 17
_PADDED = 4  # lines per resolvable one
_EVERY = 3  # rows, of which one will do
_FINE = 12  # periods on either side, that are tried
_PER_PERIOD = 4  # bins of position in the shortest period


def strongest_periods(evidence: Evidence, fitted: Fit, bounds: tuple[float, float]) -> list[float]:
    """Return the periods over position, within bounds, of the strongest lines of a remainder.

    One per record, strongest first, refined until all records agree on its phase.
    """
    seen = _placed(evidence, fitted)
    lines = [line for line in (_over_position(*one, bounds) for one in seen) if line is not None]
    lines.sort(key=lambda line: -line[1])
    return [float(np.clip(_in_phase(seen, period), *bounds)) for period, _ in lines]


def line_over(place: FloatArray, gap: FloatArray, bounds: tuple[float, float]) -> float | None:
    """Return the period, within bounds, of the strongest line of ``gap`` over ``place``, (n,)."""
    line = _over_position(place, gap, bounds)
    return None if line is None else line[0]


def _placed(evidence: Evidence, fitted: Fit) -> list[tuple[FloatArray, FloatArray]]:
    """Return the position (n,) of the axis in the model and the remainder there, by record."""
    answers = evidence.response(fitted.effects)
    placed = []
    for part in evidence.parts:
        if part.tap is not Tap.U:
            origin = evidence.observations[part.record].origin
            place = answers[part.record][part.tap] + origin
            placed.append((place, fitted.residual[part.rows]))
    return placed


def _in_phase(seen: Sequence[tuple[FloatArray, FloatArray]], period: float) -> float:
    """Return the period near ``period`` on which the records agree best.

    First refine it by each record, whose phases may differ, then by all; records may lie far apart.
    """
    thinned = [(place[::_EVERY], gap[::_EVERY]) for place, gap in seen]
    lowest = min(float(place.min()) for place, _ in thinned)
    whole = max(float(place.max()) for place, _ in thinned) - lowest
    ways = [float(np.ptp(place)) for place, _ in thinned]
    widest = max(ways)
    reach = min((way for way in ways if way > 2.0 * period), default=widest)
    for together, wide in ((False, reach), (False, widest), (True, widest), (True, whole)):
        rates = np.linspace(-1.0, 1.0, 2 * _FINE + 1) / wide + 1.0 / period
        waves = np.array([_waves(place, gap, rates) for place, gap in thinned])
        power = np.abs(waves.sum(axis=0)) if together else np.linalg.norm(waves, axis=0)
        period = 1.0 / float(rates[int(np.argmax(power))])
    return period


def _waves(place: FloatArray, gap: FloatArray, rates: FloatArray) -> NDArray[np.complex128]:
    """Return the amplitudes (k,) of ``gap`` over ``place``, (n,), at evenly spaced rates (k,)."""
    wave = np.exp(-2j * np.pi * rates[0] * place) * gap
    turn = np.exp(-2j * np.pi * (rates[1] - rates[0]) * place)
    found = np.empty(len(rates), dtype=np.complex128)
    for number in range(len(rates)):
        found[number] = wave.sum()
        wave *= turn
    return found


def strongest_frequency(
    evidence: Evidence, residual: FloatArray, bounds: tuple[float, float]
) -> float | None:
    """Return the frequency over time, within bounds, of the strongest line; None without one."""
    from scipy.signal import detrend  # only here: it takes half a second

    best: tuple[float, float] | None = None
    for part in evidence.parts:
        time_s = evidence.observations[part.record].record.time_s
        period_s = float(time_s[-1] - time_s[0]) / max(len(time_s) - 1, 1)
        line = _peak(detrend(residual[part.rows]), period_s, bounds)
        if line is not None and (best is None or line[1] > best[1]):
            best = line
    return best[0] if best is not None else None


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
    from scipy.signal import detrend  # as above

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
