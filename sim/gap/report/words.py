"""Names and verdicts as the report says them."""

from collections.abc import Sequence

from rotemina.sim.effects.errors import EffectError
from rotemina.sim.effects.registry import effect_named
from rotemina.sim.gap.diagnosis import (
    UNKNOWN,
    AxisDiagnosis,
    Cause,
    Diagnosis,
    FittedParameter,
    Shrinkage,
    Verdict,
)
from rotemina.sim.gap.report.quantities import amount, named_unit, percent, unit_of
from rotemina.sim.records.record import Record, Tap

VERDICTS = {
    Verdict.NONE: "No gap: model and machine differ by no more than noise",
    Verdict.EXPLAINED: "Explained: the effects below account for the gap",
    Verdict.PARTLY: "Explained in part: what causes the rest is not known",
    Verdict.UNKNOWN: "Unknown: there is a gap that no effect of the catalogue explains",
    Verdict.INSUFFICIENT: "The records cannot tell: the excitation is insufficient",
}
AXIS_VERDICTS = {
    **VERDICTS,
    Verdict.NONE: "No gap of its own",
    Verdict.EXPLAINED: "Explained",
    Verdict.PARTLY: "Explained in part",
}


def effect_title(effect_id: str) -> str:
    """Return an effect's name for people; its id where it is not installed."""
    if effect_id == UNKNOWN:
        return "Unknown effect"
    try:
        return effect_named(effect_id).title
    except EffectError:
        return effect_id


def summary(diagnosis: Diagnosis, records: Sequence[Record]) -> list[str]:
    """Return the answer in plain sentences, the axes with most to say first."""
    ordered = sorted(diagnosis.axes.values(), key=lambda one: not one.causes)
    sentences = [text for one in ordered for text in _of_axis(one, records)]
    quiet = [one.axis for one in ordered if one.verdict is Verdict.NONE]
    if quiet:
        sentences.append(f"Nothing of its own to explain on {listed(quiet)}.")
    return sentences


def listed(names: Sequence[str], word: str = "and") -> str:
    """Return names as a sentence lists them."""
    if len(names) < 2:
        return "".join(names)
    return f"{', '.join(names[:-1])} {word} {names[-1]}"


def parameter_unit(parameter: FittedParameter, cause: Cause, records: Sequence[Record]) -> str:
    """Return the unit of a parameter, also where it depends on another axis."""
    source = cause.from_axis
    source_unit = unit_of(source, Tap.MEAS, records) if source is not None else ""
    return named_unit(parameter.unit, source_unit)


def _of_axis(one: AxisDiagnosis, records: Sequence[Record]) -> list[str]:
    if one.verdict is Verdict.NONE:
        return []
    if one.verdict is Verdict.INSUFFICIENT:
        return [f"{one.axis}: the records do not move it in a way that could tell what it lacks."]
    named = [_named(cause) for cause in one.causes if cause.effect != UNKNOWN]
    sentences = [f"{one.axis}: the model lacks {listed(named)}."] if named else []
    if one.verdict is Verdict.PARTLY:
        sentences.append(f"{one.axis}: what else is there, no effect here explains.")
    if one.verdict is Verdict.UNKNOWN:
        more = " beside that" if named else ""
        sentences.append(f"{one.axis}: there is a gap{more} that no effect here explains.")
    return sentences + [_closing(each, records) for each in one.shrinkage[:1]]


def _named(cause: Cause) -> str:
    text = f"{effect_title(cause.effect).lower()} ({percent(cause.probability)} likely)"
    if cause.from_axis is not None:
        text += f" from {cause.from_axis}"
    if cause.ambiguous_with:
        rivals = [effect_title(effect).lower() for effect in cause.ambiguous_with]
        text += f", or {listed(rivals, 'or')}, which these records cannot tell from it"
    return text


def _closing(shrinkage: Shrinkage, records: Sequence[Record]) -> str:
    unit = unit_of(shrinkage.axis, shrinkage.tap, records)
    text = (
        f"On data that no fit saw, its gap at {shrinkage.tap} shrinks from "
        f"{amount(shrinkage.raw, unit)} to {amount(shrinkage.corrected, unit)} rms "
        f"(noise floor {amount(shrinkage.floor, unit)})"
    )
    if shrinkage.closed is None:
        return f"{text}."
    return f"{text}: {percent(shrinkage.closed)} of it closes."
