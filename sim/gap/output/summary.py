"""A diagnosis as text for a terminal."""

from collections.abc import Iterable, Iterator, Sequence
from math import isfinite

from rotemina.sim.gap.location import LocatedGap
from rotemina.sim.gap.output import wording as sentences
from rotemina.sim.gap.output.document import compute_shares, sort_causes
from rotemina.sim.gap.output.report_words import find_parameter_unit, unit_of
from rotemina.sim.gap.result import (
    UNKNOWN_EFFECT_ID,
    Diagnosis,
    FittedParameter,
    GapCause,
    GapShrinkage,
    GapVerdict,
    Interval,
)
from rotemina.sim.messages import (
    Message,
    MessageWording,
    NumberText,
    format_fixed,
    format_rounded,
    join_messages,
    message,
)
from rotemina.sim.records import Record
from rotemina.sim.units import (
    format_interval,
    format_percent,
    format_percent_interval,
    format_quantity,
)

_ROBOT_VERDICTS = {
    GapVerdict.NONE: message("gap", "no gap: the model explains the records up to their noise"),
    GapVerdict.EXPLAINED: message("gap", "the gap is explained"),
    GapVerdict.PARTLY: message(
        "gap", "the gap is partly explained; the cause of the rest is unknown"
    ),
    GapVerdict.UNKNOWN: message("gap", "no known effect explains the gap"),
    GapVerdict.INSUFFICIENT: message("gap", "undecided: the records lack excitation"),
    GapVerdict.FAILED: message("gap", "the examination failed; the machine may have any gap"),
}
_AXIS_VERDICTS = {
    GapVerdict.NONE: message("gap", "no gap of its own"),
    GapVerdict.EXPLAINED: message("gap", "explained"),
    GapVerdict.PARTLY: message("gap", "partly explained"),
    GapVerdict.UNKNOWN: message("gap", "unknown effect"),
    GapVerdict.INSUFFICIENT: message("gap", "insufficient excitation"),
    GapVerdict.FAILED: message("gap", "not examined, because the program failed"),
}


def make_summary_text(
    diagnosis: Diagnosis, records: Sequence[Record], wording: MessageWording | None = None
) -> str:
    """Return a diagnosis as text: verdict, location, causes, shrinkage and experiments."""
    wording = wording or MessageWording()
    indented_lines = _list_lines(diagnosis, records)
    return "\n".join(
        f"{'  ' * depth}{wording.format_field(line)}" for depth, line in indented_lines
    )


def _list_lines(diagnosis: Diagnosis, records: Sequence[Record]) -> Iterator[tuple[int, str]]:
    axes = diagnosis.axes.values()
    yield 0, _prefix_with_name(diagnosis.robot.name, _ROBOT_VERDICTS[diagnosis.verdict])
    yield from ((1, sentence) for sentence in sentences.write_summary(diagnosis, records))
    for axis in axes:
        yield 1, _prefix_with_name(axis.axis, _AXIS_VERDICTS[axis.verdict])
        yield from ((2, remark) for remark in axis.remarks)
    places = diagnosis.places if diagnosis.verdict is not GapVerdict.NONE else ()
    yield from _list_section_lines(
        message("gap", "where the gap lies"),
        (
            (1, _describe_place(place, share, interval, records))
            for place, (share, interval) in zip(places, compute_shares(places), strict=True)
        ),
    )
    yield from _list_section_lines(
        message("gap", "what causes it"),
        (line for cause in sort_causes(diagnosis) for line in _describe_cause(cause, records)),
    )
    yield from _list_section_lines(
        message("gap", "how far it shrinks, rms on validation data"),
        (
            (1, _describe_shrinkage(shrinkage, records))
            for axis in axes
            for shrinkage in axis.shrinkage
        ),
    )
    yield from _list_section_lines(
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


def _list_section_lines(
    title: Message, lines: Iterable[tuple[int, str]]
) -> Iterator[tuple[int, str]]:
    section_lines = list(lines)
    if section_lines:
        yield 0, title
        yield from section_lines


def _prefix_with_name(name: str, what: str) -> Message:
    return message("gap", "{name}: {what}").fill(name=name, what=what)


def _describe_place(
    place: LocatedGap, share: float, interval: Interval, records: Sequence[Record]
) -> Message:
    unit = unit_of(place.axis, place.tap, records)
    parts = [
        message("gap", "{share} of it").fill(share=_format_share(share, interval)),
        message("gap", "rms {rms}, noise floor {floor}").fill(
            rms=format_quantity(place.gap_rms, unit), floor=format_quantity(place.noise_floor, unit)
        ),
    ]
    if place.worst_band_hz is not None:
        low, high = place.worst_band_hz
        band_text = message("gap", "mostly between {low} and {high} Hz")
        parts.append(band_text.fill(low=format_rounded(low, 3), high=format_rounded(high, 3)))
    if place.worst_regime is not None:
        regime = Message("gap", str(place.worst_regime))
        parts.append(message("gap", "largest in: {regime}").fill(regime=regime))
    return _prefix_with_name(f"{place.axis}.{place.tap}", join_messages(parts, "; "))


def _describe_cause(cause: GapCause, records: Sequence[Record]) -> Iterator[tuple[int, Message]]:
    name: str = cause.effect
    if cause.effect == UNKNOWN_EFFECT_ID:
        name = message("gap", "an unknown effect")
    if cause.from_axis is not None:
        name = message("gap", "{effect} from {axis}").fill(effect=name, axis=cause.from_axis)
    if cause.stage is not None:
        name = message("gap", "{effect} ({stage})").fill(
            effect=name, stage=Message("effects", str(cause.stage))
        )
    parts = [
        message("gap", "{effect}, probability {probability}").fill(
            effect=name, probability=format_fixed(cause.probability, 2)
        )
    ]
    if cause.closed is not None:
        share = _format_share(cause.closed, cause.closed_interval)
        parts.append(message("gap", "closes {share}").fill(share=share))
    unit = unit_of(cause.axis, cause.tap, records)
    before = format_quantity(cause.gap_before, unit)
    if isfinite(cause.gap_after):
        template = message("gap", "rms {before} without it, {after} with it")
        parts.append(template.fill(before=before, after=format_quantity(cause.gap_after, unit)))
    else:
        parts.append(message("gap", "rms {before}").fill(before=before))
    yield 1, _prefix_with_name(cause.axis, join_messages(parts, "; "))
    if cause.ambiguous_with:
        template = message("gap", "not distinguishable from: {names}")
        yield 2, template.fill(names=", ".join(cause.ambiguous_with))
    for item in cause.derived:
        template = message("gap", "{name} {value} ({interval})")
        value, interval = (
            format_quantity(item.value, item.unit),
            format_interval(item.interval, item.unit),
        )
        yield 2, template.fill(name=item.name, value=value, interval=interval)
    yield from ((2, _describe_parameter(item, cause, records)) for item in cause.parameters)


def _describe_parameter(
    parameter: FittedParameter, cause: GapCause, records: Sequence[Record]
) -> Message:
    unit = find_parameter_unit(parameter, cause, records)
    value = format_quantity(parameter.value, unit)
    if parameter.interval is not None:
        value = NumberText(f"{value} ({format_interval(parameter.interval, unit)})")
    text = message("gap", "{name} = {value}").fill(name=parameter.name, value=value)
    if parameter.at_bound is None:
        return text
    bound = message("gap", "at its {end} bound").fill(end=parameter.at_bound)
    return join_messages((text, bound), ", ")


def _describe_shrinkage(shrinkage: GapShrinkage, records: Sequence[Record]) -> Message:
    unit = unit_of(shrinkage.axis, shrinkage.tap, records)
    figures = (
        (message("gap", "original {rms}"), shrinkage.raw),
        (message("gap", "re-tuned {rms}"), shrinkage.retuned),
        (message("gap", "corrected {rms}"), shrinkage.corrected),
        (message("gap", "black box {rms}"), shrinkage.ceiling),
        (message("gap", "floor {rms}"), shrinkage.floor),
    )
    parts = [text.fill(rms=format_quantity(rms, unit)) for text, rms in figures if rms is not None]
    text = join_messages(parts, ", ")
    if shrinkage.closed is not None:
        share = _format_share(shrinkage.closed, shrinkage.closed_interval)
        text = join_messages((text, message("gap", "closed {share}").fill(share=share)), "; ")
    return _prefix_with_name(f"{shrinkage.axis}.{shrinkage.tap}", text)


def _format_share(share: float, interval: Interval | None) -> NumberText:
    return NumberText(
        format_percent(share)
        if interval is None
        else f"{format_percent(share)} ({format_percent_interval(interval)})"
    )
