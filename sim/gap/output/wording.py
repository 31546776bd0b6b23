"""A diagnosis in sentences: the causes, how much the gap shrinks, and the remainder."""

from collections.abc import Iterator, Sequence

from rotemina.sim.effects import load_effect
from rotemina.sim.errors import EffectError
from rotemina.sim.gap.output.report_words import unit_of
from rotemina.sim.gap.result import (
    UNKNOWN_EFFECT_ID,
    AxisDiagnosis,
    Diagnosis,
    GapCause,
    GapShrinkage,
    GapVerdict,
)
from rotemina.sim.messages import (
    AxisName,
    EffectName,
    FieldList,
    Message,
    message,
)
from rotemina.sim.records import Record, Tap
from rotemina.sim.units import format_quantity

# Minimum probability for each name of a likelihood.
LIKELIHOODS = (
    (0.95, message("gap", "very likely")),
    (0.75, message("gap", "likely")),
    (0.0, message("gap", "possible")),
)
# Groups of predictors of a remainder. The motions of other axes are further groups.
PREDICTOR_GROUPS = {
    text.template: text
    for text in (
        message("gap", "command"),
        message("gap", "direction"),
        message("gap", "speed"),
        message("gap", "past commands"),
        message("gap", "time"),
        message("gap", "position phase"),
    )
}
# A sentence names at most this many groups of predictors.
_MAX_NAMED_GROUPS = 2


def write_findings(diagnosis: Diagnosis) -> tuple[Message, ...]:
    """Return one sentence about the causes for each axis that has a gap."""
    return tuple(_write_finding(axis) for axis in _list_axes_with_gap(diagnosis))


def write_details(diagnosis: Diagnosis, records: Sequence[Record]) -> tuple[Message, ...]:
    """Return sentences about the shrinkage and remainder of each gap, and axes without a gap."""
    sentences = [
        sentence
        for axis in _list_axes_with_gap(diagnosis)
        for sentence in _write_axis_details(axis, records)
    ]
    return (*sentences, *_name_axes_without_gap(diagnosis))


def write_summary(diagnosis: Diagnosis, records: Sequence[Record]) -> tuple[Message, ...]:
    """Return the diagnosis in sentences, axis by axis; axes with causes come first."""
    sentences: list[Message] = []
    for axis in _list_axes_with_gap(diagnosis):
        sentences += [_write_finding(axis), *_write_axis_details(axis, records)]
    return (*sentences, *_name_axes_without_gap(diagnosis))


def _list_axes_with_gap(diagnosis: Diagnosis) -> list[AxisDiagnosis]:
    axes_with_gap = [
        axis for axis in diagnosis.axes.values() if axis.verdict is not GapVerdict.NONE
    ]
    return sorted(axes_with_gap, key=lambda axis: not axis.causes)


def _name_axes_without_gap(diagnosis: Diagnosis) -> Iterator[Message]:
    names = [
        AxisName(axis.axis) for axis in diagnosis.axes.values() if axis.verdict is GapVerdict.NONE
    ]
    if names:
        yield message("gap", "No gap of its own on {axes}.").fill(axes=FieldList(tuple(names)))


def _list_known_causes(axis: AxisDiagnosis) -> list[GapCause]:
    return [cause for cause in axis.causes if cause.effect != UNKNOWN_EFFECT_ID]


def _write_finding(axis_diagnosis: AxisDiagnosis) -> Message:
    axis, causes = AxisName(axis_diagnosis.axis), _list_known_causes(axis_diagnosis)
    if axis_diagnosis.verdict is GapVerdict.INSUFFICIENT:
        template = message(
            "gap", "{axis}: the records do not move the axis enough for a diagnosis."
        )
        return template.fill(axis=axis)
    if axis_diagnosis.verdict is GapVerdict.FAILED:
        template = message("gap", "{axis}: not examined, because the program failed.")
        return template.fill(axis=axis)
    if not causes:
        return message("gap", "{axis}: a gap that no known effect explains.").fill(axis=axis)
    if len(causes) == 1 and not causes[0].ambiguous_with:
        (cause,) = causes
        template = message("gap", "{axis}: {cause}, {likelihood}.")
        return template.fill(
            axis=axis, cause=_name_cause(cause), likelihood=_describe_likelihood(cause)
        )
    listed_causes = FieldList(tuple(_describe_cause(cause) for cause in causes))
    return message("gap", "{axis}: {causes}.").fill(axis=axis, causes=listed_causes)


def _describe_cause(cause: GapCause) -> Message:
    if cause.ambiguous_with:
        other_names = map(_make_effect_name, cause.ambiguous_with)
        effects = FieldList((_name_cause(cause), *other_names), one_of_them=True)
        return message("gap", "{effects} (these records cannot distinguish them)").fill(
            effects=effects
        )
    template = message("gap", "{cause} ({likelihood})")
    return template.fill(cause=_name_cause(cause), likelihood=_describe_likelihood(cause))


def _name_cause(cause: GapCause) -> EffectName | Message:
    return name_effect(cause.effect, cause.from_axis)


def name_effect(effect: str, from_axis: str | None) -> EffectName | Message:
    """Return the name of an effect as used in a sentence, with its source axis."""
    if from_axis is None:
        return _make_effect_name(effect)
    template = message("gap", "{effect} from {axis}")
    return template.fill(effect=_make_effect_name(effect), axis=AxisName(from_axis))


def _make_effect_name(effect: str) -> EffectName:
    try:
        return EffectName(effect, load_effect(effect).title)
    except EffectError:
        # The plugin with the effect is not installed.
        return EffectName(effect)


def _describe_likelihood(cause: GapCause) -> Message:
    return next(
        text for min_probability, text in LIKELIHOODS if cause.probability >= min_probability
    )


def _write_axis_details(axis: AxisDiagnosis, records: Sequence[Record]) -> Iterator[Message]:
    known_causes = _list_known_causes(axis)
    for shrinkage in axis.shrinkage[:1]:
        if known_causes:
            yield _describe_shrinkage(shrinkage, len(known_causes) > 1, records)
        else:
            template = message("gap", "{gap} is {raw} rms (noise floor {floor}).")
            yield template.fill(
                gap=_name_gap(shrinkage, begins_sentence=True),
                **_format_figures(shrinkage, records),
            )
    if axis.verdict in (GapVerdict.PARTLY, GapVerdict.UNKNOWN):
        yield _describe_remainder(axis)


def _describe_shrinkage(
    shrinkage: GapShrinkage, has_several_causes: bool, records: Sequence[Record]
) -> Message:
    template = message(
        "gap",
        "Adding it to the model takes {gap} from {raw} to {corrected} rms on unseen data (noise "
        "floor {floor}).",
    )
    if has_several_causes:
        template = message(
            "gap",
            "Adding them to the model takes {gap} from {raw} to {corrected} rms on unseen data "
            "(noise floor {floor}).",
        )
    corrected = format_quantity(
        shrinkage.corrected, unit_of(shrinkage.axis, shrinkage.tap, records)
    )
    return template.fill(
        gap=_name_gap(shrinkage), corrected=corrected, **_format_figures(shrinkage, records)
    )


def _name_gap(shrinkage: GapShrinkage, *, begins_sentence: bool = False) -> Message:
    """Return the name of the gap, with the tap unless it is the sensor of the axis."""
    if shrinkage.tap is Tap.MEAS:
        return message("gap", "The gap") if begins_sentence else message("gap", "the gap")
    template = (
        message("gap", "The gap at {tap}")
        if begins_sentence
        else message("gap", "the gap at {tap}")
    )
    return template.fill(tap=str(shrinkage.tap))


def _format_figures(shrinkage: GapShrinkage, records: Sequence[Record]) -> dict[str, str]:
    unit = unit_of(shrinkage.axis, shrinkage.tap, records)
    return {
        "raw": format_quantity(shrinkage.raw, unit),
        "floor": format_quantity(shrinkage.floor, unit),
    }


def _describe_remainder(axis: AxisDiagnosis) -> Message:
    predictors = axis.remainder.depends_on[:_MAX_NAMED_GROUPS] if axis.remainder is not None else ()
    if not predictors:
        return message("gap", "No known effect explains the rest.")
    template = message("gap", "The rest depends on {groups}; no known effect explains it.")
    return template.fill(groups=FieldList(tuple(name_group(name) for name, _ in predictors)))


def name_group(name: str) -> Message:
    """Return the name of a group of predictors, which may be the motion of another axis."""
    kind, _, axis = name.partition(" ")
    if kind == "axis":
        return message("gap", "axis {axis}").fill(axis=AxisName(axis))
    return PREDICTOR_GROUPS[name]
