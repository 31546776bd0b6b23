"""Where a fit begins: what is periodic, placed or coupled cannot be found downhill from anywhere.

Periods and frequencies are read from the spectrum of the gap, over time or over position (Lomb,
Astrophysics and Space Science 39 (1976) 447-462); modes and places of contact are tried in several
places; the strength of a coupling is that of its regression.
"""

from dataclasses import replace

import numpy as np
from scipy.signal import lombscargle

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.formulation import Parameter
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.model import AxisEffect

_MOST_ROWS = 4000  # of a record, for a spectrum
_MOST_LINES = 4000
_FINENESS = 4.0  # lines per resolvable one
_MODES = (0.4, 1.7, 3.0)  # of the axis' own frequency
_PLACES = (0.25, 0.5, 0.75, 0.9)  # of the way from the lowest to the highest command


def starts(evidence: Evidence, candidate: AxisEffect) -> tuple[AxisEffect, ...]:
    """Return the candidate with the parameters from which its fit should be tried."""
    attached = Attached.of(evidence.robot, candidate)
    names = {parameter.name: parameter for parameter in attached.formulation.parameters}
    if "period" in names:
        preset = attached.values["period"]
        seen = _strongest(evidence, names["period"].bounds(attached.facts), over_time=False)
        return _each(candidate, "period", [preset, *([seen] if seen else [])])
    if candidate.id == "vibration":
        low, high = names["frequency"].bounds(attached.facts)
        seen = _strongest(evidence, (1.0 / high, 1.0 / low), over_time=True)
        return _each(candidate, "frequency", [1.0 / seen] if seen else [50.0])
    if "place" in names:
        return _each(candidate, "place", _places(evidence, names["place"], attached))
    if "k" in names:
        candidate = _with(candidate, k=_regressed(evidence, names["k"], attached))
    if "frequency" in names:
        modes = [share * attached.facts.pace_hz for share in _MODES]
        return _each(candidate, "frequency", modes)
    return (candidate,)


def _with(candidate: AxisEffect, **parameters: float) -> AxisEffect:
    return replace(candidate, parameters={**candidate.parameters, **parameters})


def _each(candidate: AxisEffect, name: str, values: list[float]) -> tuple[AxisEffect, ...]:
    return tuple(_with(candidate, **{name: value}) for value in values)


def _strongest(evidence: Evidence, bounds: tuple[float, float], *, over_time: bool) -> float | None:
    """Return the period, within bounds, of the strongest line of the gap over time or position."""
    best: tuple[float, float] | None = None
    for observation, gaps in zip(evidence.observations, evidence.gaps(), strict=True):
        record = observation.record
        place = record.time_s if over_time else record.signal(evidence.axis, Tap.CMD)
        for gap in gaps.values():
            line = _line(place, gap, bounds)
            if line is not None and (best is None or line[1] > best[1]):
                best = line
    return best[0] if best is not None else None


def _line(
    place: FloatArray, gap: FloatArray, bounds: tuple[float, float]
) -> tuple[float, float] | None:
    """Return period and power of the strongest line of ``gap`` over ``place``, both (n,)."""
    step = -(-len(place) // _MOST_ROWS)
    place, gap = place[::step], gap[::step]
    reach = float(np.ptp(place))
    longest, shortest = min(bounds[1], reach), max(bounds[0], 2.5 * reach / len(place))
    if reach == 0.0 or longest <= shortest:
        return None
    lines = min(int(_FINENESS * reach * (1.0 / shortest - 1.0 / longest)) + 2, _MOST_LINES)
    rates = np.linspace(1.0 / longest, 1.0 / shortest, lines)
    power = lombscargle(place - place[0], gap - gap.mean(), 2.0 * np.pi * rates)
    strongest = int(np.argmax(power))
    return float(1.0 / rates[strongest]), float(power[strongest])


def _places(evidence: Evidence, place: Parameter, attached: Attached) -> list[float]:
    commands = np.concatenate(
        [observation.record.signal(evidence.axis, Tap.CMD) for observation in evidence.observations]
    )
    low, high = place.bounds(attached.facts)
    reached = commands.min() + np.array(_PLACES) * np.ptp(commands) - attached.facts.low
    return [float(place) for place in np.clip(reached, low, high)]


def _regressed(evidence: Evidence, k: Parameter, attached: Attached) -> float:
    """Return the coupling by regression of the gap on the other axis' command."""
    above = below = 0.0
    source = attached.asked.from_axis
    assert source is not None
    for observation, gaps in zip(evidence.observations, evidence.gaps(), strict=True):
        if not observation.record.has(source, Tap.CMD):
            continue
        other = observation.record.signal(source, Tap.CMD)
        other = other - other.mean()
        for tap, gap in gaps.items():
            above += float(gap @ other) / observation.floor[tap]
            below += float(other @ other) / observation.floor[tap] ** 2
    low, high = k.bounds(attached.facts)
    return float(np.clip(above / below, low, high)) if below > 0.0 else attached.values["k"]
