"""A diagnosis in words: what a terminal shows."""

from collections.abc import Iterator, Sequence
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
from rotemina.sim.gap.report.quantities import amount, amounts, percent, percents, unit_of
from rotemina.sim.gap.report.words import parameter_unit
from rotemina.sim.gap.where import Place
from rotemina.sim.records.record import Record

_VERDICTS = {
    Verdict.NONE: "no gap: the model explains the records up to their noise",
    Verdict.EXPLAINED: "the gap is explained",
    Verdict.PARTLY: "the gap is explained in part; what causes the rest is not known",
    Verdict.UNKNOWN: "there is a gap that no known effect explains",
    Verdict.INSUFFICIENT: "the records cannot tell",
}
_TITLES = {
    Verdict.NONE: "no gap of its own",
    Verdict.EXPLAINED: "explained",
    Verdict.PARTLY: "explained in part",
    Verdict.UNKNOWN: "unknown effect",
    Verdict.INSUFFICIENT: "insufficient excitation",
}


def summary(diagnosis: Diagnosis, records: Sequence[Record]) -> str:
    """Return a diagnosis of records as text: verdict, where, which, how far, what next."""
    return "\n".join(_lines(diagnosis, records))


def _lines(diagnosis: Diagnosis, records: Sequence[Record]) -> Iterator[str]:
    axes = diagnosis.axes.values()
    yield f"{diagnosis.robot.name}: {_VERDICTS[diagnosis.verdict]}"
    for axis in axes:
        yield f"  {axis.axis}: {_TITLES[axis.verdict]}"
        yield from (f"    {remark}" for remark in axis.remarks)
    places = diagnosis.places if diagnosis.verdict is not Verdict.NONE else ()
    yield from _part(
        "where the gap lies",
        [
            _place(place, share, interval, records)
            for place, (share, interval) in zip(places, shares(places), strict=True)
        ],
    )
    yield from _part(
        "what causes it",
        [line for cause in ordered_causes(diagnosis) for line in _cause(cause, records)],
    )
    yield from _part(
        "how far it shrinks, rms on data that no fit saw",
        [_shrinkage(each, records) for axis in axes for each in axis.shrinkage],
    )
    yield from _part(
        "what these records cannot speak of", [line for axis in axes for line in _untested(axis)]
    )
    yield from _part(
        "what would tell more",
        [
            f"experiment {number}, on {experiment.axis}: {experiment.why}"
            for number, experiment in enumerate(diagnosis.experiments, start=1)
        ],
    )


def _part(title: str, lines: Sequence[str]) -> Iterator[str]:
    if lines:
        yield title
        yield from (f"  {line}" for line in lines)


def _place(place: Place, share: float, interval: Interval, records: Sequence[Record]) -> str:
    unit = unit_of(place.axis, place.tap, records)
    text = (
        f"{place.axis}.{place.tap}: {_percent(share, interval)} of it; rms "
        f"{amount(place.gap_rms, unit)}, noise floor {amount(place.noise_floor, unit)}"
    )
    if place.worst_band_hz is not None:
        low, high = place.worst_band_hz
        text += f"; most between {low:.3g} and {high:.3g} Hz"
    if place.worst_regime is not None:
        text += f"; largest in: {place.worst_regime}"
    return text


def _cause(cause: Cause, records: Sequence[Record]) -> Iterator[str]:
    name = "an unknown effect" if cause.effect == UNKNOWN else cause.effect
    source = f" from {cause.from_axis}" if cause.from_axis is not None else ""
    stage = f" ({cause.stage})" if cause.stage is not None else ""
    text = f"{cause.axis}: {name}{source}{stage}, probability {cause.probability:.2f}"
    if cause.closed is not None:
        text += f"; closes {_percent(cause.closed, cause.closed_interval)}"
    unit = unit_of(cause.axis, cause.tap, records)
    text += f"; rms {amount(cause.gap_before, unit)}"
    if isfinite(cause.gap_after):
        text += f" without it, {amount(cause.gap_after, unit)} with it"
    yield text
    if cause.ambiguous_with:
        yield f"  cannot be told from: {', '.join(cause.ambiguous_with)}"
    yield from (
        f"  {one.name} {amount(one.value, one.unit)} ({amounts(one.interval, one.unit)})"
        for one in cause.derived
    )
    yield from (f"  {_parameter(one, cause, records)}" for one in cause.parameters)


def _parameter(one: FittedParameter, cause: Cause, records: Sequence[Record]) -> str:
    unit = parameter_unit(one, cause, records)
    text = f"{one.name} = {amount(one.value, unit)}"
    if one.interval is not None:
        text += f" ({amounts(one.interval, unit)})"
    if one.at_bound is not None:
        text += f", at its {one.at_bound} bound"
    return text


def _shrinkage(each: Shrinkage, records: Sequence[Record]) -> str:
    unit = unit_of(each.axis, each.tap, records)
    figures = [
        ("as it is", each.raw),
        ("re-tuned", each.retuned),
        ("corrected", each.corrected),
        ("black box", each.ceiling),
        ("floor", each.floor),
    ]
    told = ", ".join(f"{name} {amount(rms, unit)}" for name, rms in figures if rms is not None)
    text = f"{each.axis}.{each.tap}: {told}"
    if each.closed is not None:
        text += f"; closed {_percent(each.closed, each.closed_interval)}"
    return text


def _untested(axis: AxisDiagnosis) -> Iterator[str]:
    reasons: dict[str, list[str]] = {}
    for one in axis.untestable:
        reasons.setdefault(one.reason, []).append(one.effect)
    for reason, effects in reasons.items():
        yield f"{axis.axis}: {', '.join(effects)}: {reason}"


def _percent(share: float, interval: Interval | None) -> str:
    return percent(share) if interval is None else f"{percent(share)} ({percents(interval)})"
