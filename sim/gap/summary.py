"""A diagnosis in words: what a terminal shows."""

from collections.abc import Iterator
from math import isfinite

from rotemina.sim.gap.diagnosis import (
    UNKNOWN,
    AxisDiagnosis,
    Cause,
    Diagnosis,
    FittedParameter,
    Interval,
    Shrinkage,
    Verdict,
)
from rotemina.sim.gap.document import ordered_causes, shares
from rotemina.sim.records.record import VOLTAGE_TAPS, Tap
from rotemina.sim.units import drawing_unit, symbol, to_unit

_VERDICTS = {
    Verdict.NONE: "no gap: the model explains the records up to their noise",
    Verdict.EXPLAINED: "the gap is explained",
    Verdict.UNKNOWN: "there is a gap that no known effect explains",
    Verdict.INSUFFICIENT: "the records cannot tell",
}
_TITLES = {
    Verdict.NONE: "no gap",
    Verdict.EXPLAINED: "explained",
    Verdict.UNKNOWN: "unknown effect",
    Verdict.INSUFFICIENT: "insufficient excitation",
}


def summary(diagnosis: Diagnosis) -> str:
    """Return a diagnosis as text: verdict, where, which, how far, what next."""
    return "\n".join(_lines(diagnosis))


def _lines(diagnosis: Diagnosis) -> Iterator[str]:
    yield f"{diagnosis.robot.name}: {_VERDICTS[diagnosis.verdict]}"
    for axis in diagnosis.axes.values():
        yield f"  {axis.axis}: {_TITLES[axis.verdict]}"
        yield from (f"    {remark}" for remark in axis.remarks)
    places = diagnosis.places
    if places:
        yield "where the gap lies"
    for place, (share, interval) in zip(places, shares(places), strict=True):
        rms = _size(diagnosis, place.axis, place.tap, place.gap_rms)
        floor = _size(diagnosis, place.axis, place.tap, place.noise_floor)
        yield (
            f"  {place.axis}.{place.tap}: {_percent(share, interval)} of it; rms {rms}, noise "
            f"floor {floor}; {_worst(place.worst_band_hz, place.worst_regime)}".rstrip("; ")
        )
    causes = ordered_causes(diagnosis)
    if causes:
        yield "what causes it"
    for cause in causes:
        yield from _cause(diagnosis, cause)
    steps = [each for axis in diagnosis.axes.values() for each in axis.shrinkage]
    if steps:
        yield "how far it shrinks, on data that no fit saw"
    yield from (f"  {_shrinkage(diagnosis, each)}" for each in steps)
    untested = [line for axis in diagnosis.axes.values() for line in _untested(axis)]
    if untested:
        yield "what these records cannot speak of"
    yield from (f"  {line}" for line in untested)
    if diagnosis.experiments:
        yield "what would tell more"
    for number, experiment in enumerate(diagnosis.experiments, start=1):
        yield f"  experiment {number}, on {experiment.axis}: {experiment.why}"


def _worst(band_hz: Interval | None, regime: str | None) -> str:
    parts = []
    if band_hz is not None:
        parts.append(f"most between {band_hz[0]:.3g} and {band_hz[1]:.3g} Hz")
    if regime is not None:
        parts.append(f"largest in: {regime}")
    return ", ".join(parts)


def _cause(diagnosis: Diagnosis, cause: Cause) -> Iterator[str]:
    name = "an unknown effect" if cause.effect == UNKNOWN else cause.effect
    source = f" from {cause.from_axis}" if cause.from_axis is not None else ""
    stage = f" ({cause.stage})" if cause.stage is not None else ""
    line = f"  {cause.axis}: {name}{source}{stage}, probability {cause.probability:.2f}"
    if cause.closed is not None:
        line += f"; closes {_percent(cause.closed, cause.closed_interval)}"
    line += f"; rms {_size(diagnosis, cause.axis, cause.tap, cause.gap_before)}"
    if isfinite(cause.gap_after):
        after = _size(diagnosis, cause.axis, cause.tap, cause.gap_after)
        line += f" without it, {after} with it"
    yield line
    if cause.ambiguous_with:
        yield f"    cannot be told from: {', '.join(cause.ambiguous_with)}"
    yield from (f"    {_parameter(one)}" for one in cause.parameters)


def _parameter(one: FittedParameter) -> str:
    text = f"{one.name} = {one.value:.4g} {one.unit}".rstrip()
    if one.interval is not None:
        text += f" ({one.interval[0]:.4g} to {one.interval[1]:.4g})"
    if one.at_bound is not None:
        text += f", at its {one.at_bound} bound"
    return text


def _shrinkage(diagnosis: Diagnosis, each: Shrinkage) -> str:
    figures = [
        ("as it is", each.raw),
        ("re-tuned", each.retuned),
        ("corrected", each.corrected),
        ("black box", each.ceiling),
        ("floor", each.floor),
    ]
    told = ", ".join(
        f"{name} {_size(diagnosis, each.axis, each.tap, rms)}"
        for name, rms in figures
        if rms is not None
    )
    closed = ""
    if each.closed is not None:
        closed = f"; closed {_percent(each.closed, each.closed_interval)}"
    return f"{each.axis}.{each.tap}: {told}{closed}"


def _untested(axis: AxisDiagnosis) -> Iterator[str]:
    reasons: dict[str, list[str]] = {}
    for one in axis.untestable:
        reasons.setdefault(one.reason, []).append(one.effect)
    for reason, effects in reasons.items():
        yield f"{axis.axis}: {', '.join(effects)}: {reason}"


def _percent(share: float, interval: Interval | None) -> str:
    text = f"{100.0 * share:.3g} %"
    if interval is not None:
        text += f" ({100.0 * interval[0]:.3g} to {100.0 * interval[1]:.3g})"
    return text


def _size(diagnosis: Diagnosis, axis: str, tap: Tap, rms: float) -> str:
    if not isfinite(rms):
        return "not known"
    si_unit = "V" if tap in VOLTAGE_TAPS else diagnosis.robot.unit(axis)
    if si_unit is None:
        return f"{rms:.4g} (SI)"
    unit = drawing_unit(si_unit, rms)
    return f"{to_unit(rms, unit):.4g} {symbol(unit)}"
