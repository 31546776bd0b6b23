"""A diagnosis as text for a terminal."""

from collections.abc import Iterable, Iterator, Sequence
from math import isfinite

from rotemina.sim.gap.diagnosis import (
    UNKNOWN,
    Cause,
    Diagnosis,
    FittedParameter,
    Interval,
    Shrinkage,
    Verdict,
)
from rotemina.sim.gap.location.located_gap import LocatedGap
from rotemina.sim.gap.output import wording as sentences
from rotemina.sim.gap.output.document import ordered_causes, shares
from rotemina.sim.gap.output.report.quantities import unit_of
from rotemina.sim.gap.output.report.words import parameter_unit
from rotemina.sim.messages import Message, Wording, joined, message
from rotemina.sim.quantities import Number, amount, amounts, fixed, percent, percents, rounded
from rotemina.sim.records.record import Record

_VERDICTS = {
    Verdict.NONE: message("gap", "no gap: the model explains the records up to their noise"),
    Verdict.EXPLAINED: message("gap", "the gap is explained"),
    Verdict.PARTLY: message("gap", "the gap is partly explained; the cause of the rest is unknown"),
    Verdict.UNKNOWN: message("gap", "no known effect explains the gap"),
    Verdict.INSUFFICIENT: message("gap", "undecided: the records lack excitation"),
}
_TITLES = {
    Verdict.NONE: message("gap", "no gap of its own"),
    Verdict.EXPLAINED: message("gap", "explained"),
    Verdict.PARTLY: message("gap", "partly explained"),
    Verdict.UNKNOWN: message("gap", "unknown effect"),
    Verdict.INSUFFICIENT: message("gap", "insufficient excitation"),
}


def summary(diagnosis: Diagnosis, records: Sequence[Record], wording: Wording | None = None) -> str:
    """Return a diagnosis of records as text: verdict, where, which, how far, what next."""
    wording = wording or Wording()
    told = _lines(diagnosis, records)
    return "\n".join(f"{'  ' * depth}{wording.shown(line)}" for depth, line in told)


def _lines(diagnosis: Diagnosis, records: Sequence[Record]) -> Iterator[tuple[int, str]]:
    """Yield each line with how deep it is indented."""
    axes = diagnosis.axes.values()
    yield 0, _named(diagnosis.robot.name, _VERDICTS[diagnosis.verdict])
    yield from ((1, sentence) for sentence in sentences.summary(diagnosis, records))
    for axis in axes:
        yield 1, _named(axis.axis, _TITLES[axis.verdict])
        yield from ((2, remark) for remark in axis.remarks)
    places = diagnosis.places if diagnosis.verdict is not Verdict.NONE else ()
    yield from _part(
        message("gap", "where the gap lies"),
        (
            (1, _place(place, share, interval, records))
            for place, (share, interval) in zip(places, shares(places), strict=True)
        ),
    )
    yield from _part(
        message("gap", "what causes it"),
        (line for cause in ordered_causes(diagnosis) for line in _cause(cause, records)),
    )
    yield from _part(
        message("gap", "how far it shrinks, rms on validation data"),
        ((1, _shrinkage(each, records)) for axis in axes for each in axis.shrinkage),
    )
    yield from _part(
        message("gap", "suggested experiments"),
        (
            (
                1,
                message("gap", "experiment {number}, on {axis}: {why}").fill(
                    number=number, axis=experiment.axis, why=experiment.why
                ),
            )
            for number, experiment in enumerate(diagnosis.experiments, start=1)
        ),
    )


def _part(title: Message, lines: Iterable[tuple[int, str]]) -> Iterator[tuple[int, str]]:
    told = list(lines)
    if told:
        yield 0, title
        yield from told


def _named(name: str, what: str) -> Message:
    return message("gap", "{name}: {what}").fill(name=name, what=what)


def _place(
    place: LocatedGap, share: float, interval: Interval, records: Sequence[Record]
) -> Message:
    unit = unit_of(place.axis, place.tap, records)
    said = [
        message("gap", "{share} of it").fill(share=_percent(share, interval)),
        message("gap", "rms {rms}, noise floor {floor}").fill(
            rms=amount(place.gap_rms, unit), floor=amount(place.noise_floor, unit)
        ),
    ]
    if place.worst_band_hz is not None:
        low, high = place.worst_band_hz
        most = message("gap", "mostly between {low} and {high} Hz")
        said.append(most.fill(low=rounded(low, 3), high=rounded(high, 3)))
    if place.worst_regime is not None:
        regime = Message("gap", str(place.worst_regime))
        said.append(message("gap", "largest in: {regime}").fill(regime=regime))
    return _named(f"{place.axis}.{place.tap}", joined(said, "; "))


def _cause(cause: Cause, records: Sequence[Record]) -> Iterator[tuple[int, Message]]:
    name: str = cause.effect
    if cause.effect == UNKNOWN:
        name = message("gap", "an unknown effect")
    if cause.from_axis is not None:
        name = message("gap", "{effect} from {axis}").fill(effect=name, axis=cause.from_axis)
    if cause.stage is not None:
        name = message("gap", "{effect} ({stage})").fill(
            effect=name, stage=Message("effects", str(cause.stage))
        )
    said = [
        message("gap", "{effect}, probability {probability}").fill(
            effect=name, probability=fixed(cause.probability, 2)
        )
    ]
    if cause.closed is not None:
        share = _percent(cause.closed, cause.closed_interval)
        said.append(message("gap", "closes {share}").fill(share=share))
    unit = unit_of(cause.axis, cause.tap, records)
    before = amount(cause.gap_before, unit)
    if isfinite(cause.gap_after):
        both = message("gap", "rms {before} without it, {after} with it")
        said.append(both.fill(before=before, after=amount(cause.gap_after, unit)))
    else:
        said.append(message("gap", "rms {before}").fill(before=before))
    yield 1, _named(cause.axis, joined(said, "; "))
    if cause.ambiguous_with:
        others = message("gap", "not distinguishable from: {names}")
        yield 2, others.fill(names=", ".join(cause.ambiguous_with))
    for one in cause.derived:
        told = message("gap", "{name} {value} ({interval})")
        value, interval = amount(one.value, one.unit), amounts(one.interval, one.unit)
        yield 2, told.fill(name=one.name, value=value, interval=interval)
    yield from ((2, _parameter(one, cause, records)) for one in cause.parameters)


def _parameter(one: FittedParameter, cause: Cause, records: Sequence[Record]) -> Message:
    unit = parameter_unit(one, cause, records)
    value = amount(one.value, unit)
    if one.interval is not None:
        value = Number(f"{value} ({amounts(one.interval, unit)})")
    said = message("gap", "{name} = {value}").fill(name=one.name, value=value)
    if one.at_bound is None:
        return said
    bound = message("gap", "at its {end} bound").fill(end=one.at_bound)
    return joined((said, bound), ", ")


def _shrinkage(each: Shrinkage, records: Sequence[Record]) -> Message:
    unit = unit_of(each.axis, each.tap, records)
    figures = (
        (message("gap", "original {rms}"), each.raw),
        (message("gap", "re-tuned {rms}"), each.retuned),
        (message("gap", "corrected {rms}"), each.corrected),
        (message("gap", "black box {rms}"), each.ceiling),
        (message("gap", "floor {rms}"), each.floor),
    )
    told = [said.fill(rms=amount(rms, unit)) for said, rms in figures if rms is not None]
    said = joined(told, ", ")
    if each.closed is not None:
        share = _percent(each.closed, each.closed_interval)
        said = joined((said, message("gap", "closed {share}").fill(share=share)), "; ")
    return _named(f"{each.axis}.{each.tap}", said)


def _percent(share: float, interval: Interval | None) -> Number:
    return Number(
        percent(share) if interval is None else f"{percent(share)} ({percents(interval)})"
    )
