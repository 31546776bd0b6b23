"""What the page calls verdicts, effects and regimes, in the language of the window.

The diagnosis says them in English: these tables mark its words for translation. What is not among
them, as a plugin's effect, is shown as the diagnosis says it. Effects and formulations are marked
where they are switched, in the context of the effects panel.
"""

from collections.abc import Iterator, Sequence

from rotemina.app.display import label
from rotemina.app.shell.language import marked, translate
from rotemina.sim.gap.diagnosis import (
    UNKNOWN,
    AxisDiagnosis,
    Cause,
    Diagnosis,
    Shrinkage,
    Verdict,
)
from rotemina.sim.gap.regimes import Regime
from rotemina.sim.gap.report import words
from rotemina.sim.gap.report.quantities import amount, percent, unit_of
from rotemina.sim.records.record import Record

UNKNOWN_EFFECT = marked("gap", "Unknown effect")
VERDICTS = {
    Verdict.NONE: marked("gap", "No gap: model and machine differ by no more than noise"),
    Verdict.EXPLAINED: marked("gap", "Explained: the effects below account for the gap"),
    Verdict.PARTLY: marked("gap", "Explained in part: what causes the rest is not known"),
    Verdict.UNKNOWN: marked(
        "gap", "Unknown: there is a gap that no effect of the catalogue explains"
    ),
    Verdict.INSUFFICIENT: marked("gap", "The records cannot tell: the excitation is insufficient"),
}
AXIS_VERDICTS = {
    **VERDICTS,
    Verdict.NONE: marked("gap", "No gap of its own"),
    Verdict.EXPLAINED: marked("gap", "Explained"),
    Verdict.PARTLY: marked("gap", "Explained in part"),
}
REGIMES = {
    Regime.REST: marked("gap", "rest"),
    Regime.SETTLING: marked("gap", "settling"),
    Regime.REVERSAL: marked("gap", "reversal"),
    Regime.FORWARD: marked("gap", "forward"),
    Regime.BACKWARD: marked("gap", "backward"),
    Regime.FAST: marked("gap", "fast"),
    Regime.SLOW: marked("gap", "slow"),
    Regime.OTHER_AXIS: marked("gap", "other axis moving"),
    Regime.LARGE_SWING: marked("gap", "large swing"),
    Regime.SMALL_SWING: marked("gap", "small swing"),
    Regime.LOW_END: marked("gap", "low end of travel"),
    Regime.MIDDLE: marked("gap", "middle of travel"),
    Regime.HIGH_END: marked("gap", "high end of travel"),
    Regime.FIRST_QUARTER: marked("gap", "first quarter of a turn"),
    Regime.SECOND_QUARTER: marked("gap", "second quarter of a turn"),
    Regime.THIRD_QUARTER: marked("gap", "third quarter of a turn"),
    Regime.LAST_QUARTER: marked("gap", "last quarter of a turn"),
}
# What is done now, as the line beside the bar of progress says it.
STAGES = {
    "reading": marked("gap", "reading"),
    "where": marked("gap", "where"),
    "screening": marked("gap", "screening"),
    "fitting": marked("gap", "fitting"),
    "deciding": marked("gap", "deciding"),
    "drawing": marked("gap", "drawing"),
}
# The figures of a blind test.
FIGURES = (
    marked("gap", "first cause right, one effect"),
    marked("gap", "… where the gap is ≥ 5 floors"),
    marked("gap", "… where it is smaller"),
    marked("gap", "one effect exactly, nothing beside it"),
    marked("gap", "truth in the reported set"),
    marked("gap", "mean size of the set"),
    marked("gap", "two effects exactly"),
    marked("gap", "three effects exactly"),
    marked("gap", "a cause that is not there"),
    marked("gap", "verdict explained or partly"),
    marked("gap", "healthy machines accused"),
    marked("gap", "unknown effects called unknown"),
    marked("gap", "poor excitation called so"),
    marked("gap", "gap closed on unseen data, median"),
    marked("gap", "gap closed, 10th percentile"),
    marked("gap", "expected calibration error"),
    marked("gap", "seconds a case, median"),
    marked("gap", "seconds a case, greatest"),
    marked("gap", "seconds a healthy case, median"),
)


def effect_title(effect_id: str) -> str:
    """Return an effect's name for people; its id where it is not installed."""
    if effect_id == UNKNOWN:
        return translate("gap", UNKNOWN_EFFECT)
    return translate("effects", words.effect_title(effect_id))


def effect_word(effect_id: str) -> str:
    """Return an effect's name as it stands within a sentence."""
    return within(words.effect_title(effect_id), effect_title(effect_id))


def within(english: str, shown: str) -> str:
    """Return a text as it stands within a sentence: an English one without its capital letters."""
    return shown.lower() if shown == english else shown


def formulation_name(name: str) -> str:
    """Return what a formulation is called."""
    return translate("effects", name.replace("_", " "))


def regime_name(regime: Regime) -> str:
    """Return what an axis does in a regime."""
    return translate("gap", REGIMES[regime]) if regime in REGIMES else str(regime)


def stage_name(stage: str) -> str:
    """Return what is done now."""
    return translate("gap", STAGES[stage]) if stage in STAGES else stage


def any_of(names: Sequence[str]) -> str:
    """Return names as a sentence lists them, of which one holds."""
    return words.listed(names, translate("gap", "or"))


def all_of(names: Sequence[str]) -> str:
    """Return names as a sentence lists them."""
    return words.listed(names, translate("gap", "and"))


def summary(diagnosis: Diagnosis, records: Sequence[Record]) -> list[str]:
    """Return the answer in plain sentences, the axes with most to say first."""
    ordered = sorted(diagnosis.axes.values(), key=lambda one: not one.causes)
    sentences = [text for one in ordered for text in _of_axis(one, records)]
    quiet = [label(one.axis) for one in ordered if one.verdict is Verdict.NONE]
    if quiet:
        text = translate("gap", "Nothing of its own to explain on {axes}.")
        sentences.append(text.format(axes=all_of(quiet)))
    return sentences


def _of_axis(one: AxisDiagnosis, records: Sequence[Record]) -> Iterator[str]:
    axis = label(one.axis)
    if one.verdict is Verdict.NONE:
        return
    if one.verdict is Verdict.INSUFFICIENT:
        text = translate(
            "gap", "{axis}: the records do not move it in a way that could tell what it lacks."
        )
        yield text.format(axis=axis)
        return
    named = [_named(cause) for cause in one.causes if cause.effect != UNKNOWN]
    if named:
        lacks = translate("gap", "{axis}: the model lacks {causes}.")
        yield lacks.format(axis=axis, causes=all_of(named))
    if one.verdict is Verdict.PARTLY:
        beside = translate("gap", "{axis}: what else is there, no effect here explains.")
        yield beside.format(axis=axis)
    if one.verdict is Verdict.UNKNOWN:
        more = translate("gap", "{axis}: there is a gap beside that that no effect here explains.")
        alone = translate("gap", "{axis}: there is a gap that no effect here explains.")
        yield (more if named else alone).format(axis=axis)
    yield from (_closing(each, records) for each in one.shrinkage[:1])


def _named(cause: Cause) -> str:
    text = translate("gap", "{effect} ({share} likely)")
    if cause.from_axis is not None:
        text = translate("gap", "{effect} ({share} likely) from {axis}")
    text = text.format(
        effect=effect_word(cause.effect),
        share=percent(cause.probability),
        axis=label(cause.from_axis or ""),
    )
    if cause.ambiguous_with:
        more = translate("gap", "{cause}, or {rivals}, which these records cannot tell from it")
        rivals = any_of([effect_word(effect) for effect in cause.ambiguous_with])
        return more.format(cause=text, rivals=rivals)
    return text


def _closing(shrinkage: Shrinkage, records: Sequence[Record]) -> str:
    unit = unit_of(shrinkage.axis, shrinkage.tap, records)
    text = translate(
        "gap",
        "On data that no fit saw, its gap at {tap} shrinks from {raw} to {corrected} rms (noise "
        "floor {floor}).",
    )
    if shrinkage.closed is not None:
        text = translate(
            "gap",
            "On data that no fit saw, its gap at {tap} shrinks from {raw} to {corrected} rms "
            "(noise floor {floor}): {share} of it closes.",
        )
    return text.format(
        tap=shrinkage.tap,
        raw=amount(shrinkage.raw, unit),
        corrected=amount(shrinkage.corrected, unit),
        floor=amount(shrinkage.floor, unit),
        share=percent(shrinkage.closed),
    )
