"""Where a fit begins: what is periodic, placed or coupled cannot be found downhill from anywhere.

Periods are read from the spectrum of what is left, over position or over time; thresholds, places,
delays and modes are tried in several sizes; the strength of a coupling is that of its regression.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects.attachment import Attached
from rotemina.sim.gap.baseline import OWN
from rotemina.sim.gap.bends import bent_ends
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.gap.fit import Fit
from rotemina.sim.gap.lines import strongest_frequency, strongest_periods
from rotemina.sim.gap.teeth import likeliest_grid
from rotemina.sim.gap.tolerances import tolerance
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.model import AxisEffect, PiezoAxis

_MOST_PERIODS = 3
_MODES = (0.4, 1.7, 3.0)  # of the axis' own frequency
_PLACES = (0.4, 0.6, 0.8, 0.92)  # of the way to the end where something is met
_SOONER = (0.0, 0.03, 0.08)  # of the travel, that a soft contact begins before a stop's place
_STIFFER = (1.0, 3.0)
_ALL_BUT = 0.96  # share blocked by a contact as stiff as one can be
_DEFLECTIONS = (0.3, 2.0)  # presets
_CENTRES = (-0.45, -0.2, 0.0, 0.2, 0.45)  # of the range, from mid-range
_HARDER = (1.0, 4.0)  # presets
_BEYOND = (0.04, 0.15)  # of that way, which a saturated amplifier does not go
_SOFT_ENDS = (0.0, 0.1)  # of the way that was seen, that a soft end lies beyond it
_RARELY = 0.002  # of the rows
_LATE = ("delay", "amplifier_lag", "sensor_lag")
_PPM = 1e-6
_SKEWS = 40  # from 1 ppm on
_LADDERS: Mapping[str, Mapping[str, tuple[float, ...]]] = {  # in presets
    "delay": {"delay": (0.3, 1.0, 4.0, 15.0)},
    "amplifier_lag": {"time_constant": (0.5, 2.0, 8.0)},
    "sensor_lag": {"time_constant": (0.5, 2.0, 8.0)},
    "slew_limit": {"rate": (10.0, 3.0, 1.0, 0.3, 0.1, 0.03)},
    "backlash": {"width": (0.1, 0.5, 2.0)},
    "friction": {"coulomb": (0.3, 3.0, 20.0), "coulomb_forward": (0.3, 3.0, 20.0)},
    "creep": {"onset": (0.3, 3.0)},
    "thermal_drift": {"time_constant": (0.03, 0.2, 1.0)},
    "hysteresis": {"width": (0.3, 1.0)},
}
# Gratings are ruled at 20 μm as a rule, else at 4, 8, 10 or 40 μm. Over records far apart, a period
# that is but nearly right is in phase with none.
_GRATINGS = (1.0, 0.2, 0.4, 0.5, 2.0)


def starts(evidence: Evidence, fitted: Fit, candidate: AxisEffect) -> tuple[AxisEffect, ...]:
    """Return the candidate with the parameters from which its fit should be tried.

    ``fitted`` is what is there already; the candidate is to explain what it leaves.
    """
    given, attached = candidate.parameters, Attached.of(evidence.robot, candidate)
    return tuple(
        replace(candidate, parameters={**given, **attached.clipped(values)})
        for values in _starts(evidence, fitted, attached)
    )


def _starts(evidence: Evidence, fitted: Fit, attached: Attached) -> Iterator[dict[str, float]]:
    names = {parameter.name for parameter in attached.formulation.parameters}
    special = _SPECIAL.get(attached.effect.id)
    ladders = _LADDERS.get(attached.effect.id, {})
    if special is not None:
        yield from special(evidence, fitted, attached)
    elif {"begin", "end"} <= names:
        yield _stretch(evidence, attached)
    elif "period" in names:
        yield from _periods(evidence, fitted, attached)
    else:
        for name, presets in ladders.items():
            if name in names:
                yield from ({name: attached.values[name] * share} for share in presets)
                if attached.effect.id in _LATE:
                    yield from _late(evidence, fitted, attached, name)
                return
        yield {}


def _late(
    evidence: Evidence, fitted: Fit, attached: Attached, name: str
) -> Iterator[dict[str, float]]:
    """Give the lateness that takes most away where the model's own parameters do nothing.

    These may have been bent to do in its place what they can.
    """
    causes = [one for one in fitted.effects if one.id not in OWN]
    residual = evidence.residual(causes)
    answers = evidence.response(causes)
    above = below = 0.0
    for part in evidence.parts:
        if part.tap is not Tap.U:
            observation = evidence.observations[part.record]
            pace = np.gradient(answers[part.record][part.tap], observation.record.time_s)
            pace = _centred(pace) / observation.floor[part.tap]
            above -= float(residual[part.rows] @ pace)
            below += float(pace @ pace)
    late_s = above / below if below > 0.0 else 0.0
    if late_s > 0.0:
        # Of a time constant, that is late.
        share = 2.0 * attached.values.get("damping_ratio", 0.5) + attached.values.get("ratio", 0.0)
        yield {name: late_s / share}


def _periods(evidence: Evidence, fitted: Fit, attached: Attached) -> Iterator[dict[str, float]]:
    parameter = attached.formulation.parameter("period")
    assert parameter is not None
    low, high = parameter.bounds(attached.facts)
    for share in _GRATINGS if attached.effect.id == "encoder_interpolation" else (1.0,):
        yield {"period": attached.values["period"] * share}
    for seen in strongest_periods(evidence, fitted, (low, high))[:_MOST_PERIODS]:
        yield {"period": seen}


def _quanta(evidence: Evidence, fitted: Fit, attached: Attached) -> Iterator[dict[str, float]]:
    parameter = attached.formulation.parameter("step")
    assert parameter is not None
    low, high = parameter.bounds(attached.facts)
    axis = evidence.robot.axes[evidence.axis]
    inputs = attached.effect.id == "quantization" and isinstance(axis, PiezoAxis)
    gain = attached.facts.gain if inputs else 1.0
    origin = attached.facts.low if attached.effect.id == "quantization" else 0.0
    yield {"step": attached.values["step"]}
    floors = [o.floor[tap] for o in evidence.observations for tap in o.floor if tap is not Tap.U]
    within = max(low * gain, min(floors, default=1e-12)), high * gain
    seen = likeliest_grid(evidence, fitted, attached.asked, within, origin, gain)
    if seen is not None:
        yield seen


def _tones(evidence: Evidence, fitted: Fit, attached: Attached) -> Iterator[dict[str, float]]:
    parameter = attached.formulation.parameter("frequency")
    assert parameter is not None
    low, high = tolerance(attached, parameter, evidence.extent)
    seen = strongest_frequency(evidence, fitted.residual, (low, high))
    yield {"frequency": seen or attached.values["frequency"]}


def _modes(evidence: Evidence, fitted: Fit, attached: Attached) -> Iterator[dict[str, float]]:
    parameter = attached.formulation.parameter("frequency")
    assert parameter is not None
    low, high = parameter.bounds(attached.facts)
    for share in _MODES:
        yield {"frequency": share * attached.facts.pace_hz}
    seen = strongest_frequency(evidence, fitted.residual, (low, high))
    if seen is not None:
        yield {"frequency": seen}


def _places(evidence: Evidence, _fitted: Fit, attached: Attached) -> Iterator[dict[str, float]]:
    """Give places where a contact may be met on the way up, and on the way down."""
    parameter = attached.formulation.parameter("place")
    assert parameter is not None
    low, high = parameter.bounds(attached.facts)
    strength = next(name for name in ("stiffness", "blocked") if name in attached.values)
    least, most = evidence.reach
    if attached.asked.parameters:  # a crude form was fitted there
        place, hard = attached.values["place"], attached.values[strength]
        for before in _SOONER:
            sooner = place - float(np.sign(hard)) * before * (most - least)
            for times in _STIFFER:
                yield {"place": sooner, strength: hard * times}
        return
    for sign in (1.0, -1.0):
        for share in _PLACES:
            place = least if sign < 0.0 else most
            place -= sign * (1.0 - share) * (most - least)
            yield {
                "place": float(np.clip(place - attached.facts.low, low, high)),
                strength: sign * abs(attached.values[strength]),
            }


def from_stop(fitted: Mapping[str, float]) -> dict[str, float]:
    """Return place and stiffness of a contact whose crude form blocks a share of the motion.

    A spring k beside the axis' own K takes the share k/(k + K).
    """
    share = min(abs(fitted["blocked"]), _ALL_BUT)
    return {
        "place": fitted["place"],
        "stiffness": float(np.copysign(share / (1.0 - share), fitted["blocked"])),
    }


def _stretch(evidence: Evidence, attached: Attached) -> dict[str, float]:
    """Return the stretch that is travelled, as shares of the range."""
    least, most = evidence.reach
    more = _BEYOND[0] * (most - least)
    facts = attached.facts
    shares = ((least - more - facts.low) / facts.span, (most + more - facts.low) / facts.span)
    return {"begin": shares[0], "end": shares[1]}


def _slips(_evidence: Evidence, _fitted: Fit, attached: Attached) -> Iterator[dict[str, float]]:
    names = ("coulomb", "coulomb_forward", "viscous")
    dry = next(name for name in names if name in attached.values)
    for share in _LADDERS["friction"].get(dry, (1.0,)):
        start = {dry: attached.values[dry] * share}
        if "shape" not in attached.values:
            yield start
            continue
        for times in _DEFLECTIONS:
            yield {**start, "deflection": attached.values["deflection"] * times}


def _centres(_evidence: Evidence, _fitted: Fit, attached: Attached) -> Iterator[dict[str, float]]:
    if attached.asked.parameters:  # a simpler form was fitted there
        yield {}
        return
    for share in _CENTRES:
        for times in _HARDER:
            yield {
                "centre": share * attached.facts.span,
                "hardening": times * attached.values["hardening"],
            }


def _margins(evidence: Evidence, fitted: Fit, attached: Attached) -> Iterator[dict[str, float]]:
    """Give ends beyond which an amplifier does not go: a little of the way that is asked for."""
    facts = attached.facts
    seen = [one.real[Tap.U] for one in evidence.observations if Tap.U in one.real]
    if seen:
        # What saturates goes no further than it was seen to go.
        ends = min(float(u.min()) for u in seen), max(float(u.max()) for u in seen)
        yield {
            "low_margin": ends[0] - facts.input_low,
            "high_margin": facts.input_high - ends[1],
        }
        if facts.kind == "piezo" and "softness" in attached.values:
            # An end that these voltages do not come near may as well lie beyond the range.
            bend = bent_ends(*_voltages(evidence, fitted), ends)
            for one in (
                bend,
                bend.without_low(facts.input_low),
                bend.without_high(facts.input_high),
            ):
                yield {
                    "low_margin": one.low - facts.input_low,
                    "high_margin": facts.input_high - one.high,
                    "softness": one.softness,
                }
    if facts.kind == "force":  # whose commands ask for no voltage
        if not seen:
            yield {}
        return
    gain = facts.gain if facts.kind == "piezo" else 1.0
    went = _way(evidence) / gain
    for beyond in _SOFT_ENDS if "softness" in attached.values else (0.0,):
        further = beyond * float(np.ptp(went))
        yield {
            "low_margin": went[0] - further - facts.input_low,
            "high_margin": facts.input_high - went[1] - further,
        }
    least, most = (end / gain for end in evidence.reach)
    low, high = least - facts.input_low, facts.input_high - most
    for share in _BEYOND:
        beyond = share * (most - least)
        yield {"low_margin": low + beyond, "high_margin": high + beyond}
        yield {"low_margin": low - beyond, "high_margin": high + beyond}
        yield {"low_margin": low + beyond, "high_margin": high - beyond}


def _way(evidence: Evidence) -> FloatArray:
    """Return where (2,) the axis was at least and at most, m or rad, but for outliers."""
    seen = [
        next(signal for tap, signal in one.real.items() if tap is not Tap.U)
        for one in evidence.observations
        if set(one.real) - {Tap.U}
    ]
    if not seen:
        return np.asarray(evidence.reach)
    return np.asarray(np.quantile(np.concatenate(seen), (_RARELY, 1.0 - _RARELY)))


def _voltages(evidence: Evidence, fitted: Fit) -> tuple[FloatArray, FloatArray]:
    """Return the voltages (n,) that the model gives and those that were measured, V."""
    answers = evidence.response(fitted.effects)
    both = [
        (answer[Tap.U], observation.real[Tap.U])
        for observation, answer in zip(evidence.observations, answers, strict=True)
        if Tap.U in observation.real
    ]
    return np.concatenate([one for one, _ in both]), np.concatenate([one for _, one in both])


def _couplings(evidence: Evidence, fitted: Fit, attached: Attached) -> Iterator[dict[str, float]]:
    k = _regressed(evidence, fitted, attached)
    if attached.formulation.parameter("frequency") is None:
        yield {"k": k}
        return
    for start in _modes(evidence, fitted, attached):
        yield {"k": k or attached.values["k"], **start}


def _skews(evidence: Evidence, fitted: Fit, attached: Attached) -> Iterator[dict[str, float]]:
    """Give the rate at which the model's readings, read by such a clock, leave least."""
    parameter = attached.formulation.parameter("skew")
    assert parameter is not None
    low, high = parameter.bounds(attached.facts)
    sizes = np.geomspace(1.0, high, _SKEWS)
    tried = np.concatenate([-sizes[sizes <= -low], sizes])
    left = np.zeros(len(tried))
    answers = evidence.response(fitted.effects)
    for observation, answer in zip(evidence.observations, answers, strict=True):
        if Tap.MEAS not in answer:
            continue
        time_s, real = observation.record.time_s, observation.real[Tap.MEAS]
        for number, skew in enumerate(tried):
            when = time_s - (time_s - time_s[0]) * _PPM * skew
            gap = _centred(real - np.interp(when, time_s, answer[Tap.MEAS]))
            left[number] += float(gap @ gap) / observation.floor[Tap.MEAS] ** 2
    yield {"skew": float(tried[int(np.argmin(left))])}


def _regressed(evidence: Evidence, fitted: Fit, attached: Attached) -> float:
    """Return the coupling by regression of what is left on the other axis' command."""
    above = below = 0.0
    source = attached.asked.from_axis
    assert source is not None
    for part in evidence.parts:
        observation = evidence.observations[part.record]
        if part.tap is Tap.U or not observation.record.has(source, Tap.CMD):
            continue
        other = _centred(observation.record.signal(source, Tap.CMD))
        other = other / observation.floor[part.tap]
        above += float(fitted.residual[part.rows] @ other)
        below += float(other @ other)
    parameter = attached.formulation.parameter("k")
    assert parameter is not None
    low, high = parameter.bounds(attached.facts)
    return float(np.clip(above / below, low, high)) if below > 0.0 else attached.values["k"]


def _centred(signal: FloatArray) -> FloatArray:
    return np.asarray(signal - signal.mean())


_Maker = Callable[[Evidence, Fit, Attached], Iterator[dict[str, float]]]
_SPECIAL: Mapping[str, _Maker] = {
    "quantization": _quanta,
    "sensor_quantization": _quanta,
    "vibration": _tones,
    "flexible_mode": _modes,
    "contact": _places,
    "friction": _slips,
    "saturation": _margins,
    "stiffness_nonlinearity": _centres,
    "cross_coupling": _couplings,
    "clock_skew": _skews,
}
