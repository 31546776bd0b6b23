"""Explains a verdict to the operator, and advises on the next step. Does not use Qt."""

from collections.abc import Iterator

from rotemina.app.language import get_axis_label
from rotemina.plugins.gap import mark, tr
from rotemina.plugins.gap.answer.words import effect_word, join_with_or
from rotemina.sim.gap.result import (
    CORRECTING_VERDICTS,
    AxisDiagnosis,
    GapVerdict,
)
from rotemina.sim.messages import join_names

FIRST_STEPS = mark(
    "1  Choose records of the real machine: choose files, or play a trajectory "
    "and use its record.\n2  Diagnose: find where and why the model differs from"
    " the records.\n3  Use the answer: add the causes to the model, check it "
    "with a new motion, keep the report."
)
ONE_RECORD_CHOSEN = mark("One record is chosen.")
RECORDS_CHOSEN = mark("{n} records are chosen.")
HOW_TO_DIAGNOSE = mark(
    "Press Diagnose to find where the model differs from the measurements, "
    "which effect it lacks, and how far the gap shrinks with that effect. This "
    "takes about half a minute for each axis with a gap; you can stop it at any"
    " time."
)
NO_UNSEEN_MOTION = mark(
    "This page shows how far the gap shrinks on a motion that the diagnosis has not seen.\n"
    "Press “New motion …”, or play any trajectory of the diagnosed axes."
)

_MEANING_AND_ADVICE = {
    GapVerdict.NONE: (
        mark("The model matches the machine in these motions."),
        mark("Use the model as it is. Effects that these motions do not excite are not ruled out."),
    ),
    GapVerdict.EXPLAINED: (
        mark("The model lacks the effects named below; with them, it follows the machine."),
        mark("Press “Use corrected model”; then “New motion …” shows how far the gap shrinks."),
    ),
    GapVerdict.PARTLY: (
        mark(
            "The effects named below are present; no effect of the catalogue explains "
            "the rest of the gap."
        ),
        mark(
            "Press “Use corrected model”: it follows the machine better. The page Where"
            " shows what the rest depends on."
        ),
    ),
    GapVerdict.UNKNOWN: (
        mark("The gap is real, but no effect of the catalogue explains it."),
        mark(
            "The page Where shows what it depends on. Check cables, clamps and sensor; "
            "record again, slower and faster. Keep the report for the maintainer of the"
            " model."
        ),
    ),
    GapVerdict.FAILED: (
        mark("The program failed to examine this axis. This says nothing about the machine."),
        mark("Save a support bundle with these records, and send it to the maintainer."),
    ),
    GapVerdict.INSUFFICIENT: (
        mark(
            "These motions cannot distinguish the effects: they are too short, too "
            "small or too similar."
        ),
        mark(
            "Press “Play next experiment …”, or add records of other motions (multisine, "
            "staircase, "
            "swings), and diagnose them together."
        ),
    ),
}


def explain_verdict(diagnosis: AxisDiagnosis, *, has_experiment: bool) -> Iterator[str]:
    """Yield sentences that explain the verdict of an axis, and what to do."""
    meaning, advice = (tr(text) for text in _MEANING_AND_ADVICE[diagnosis.verdict])
    rivals = {rival for cause in diagnosis.causes for rival in cause.ambiguous_with}
    yield tr("What it means: {meaning}").format(meaning=meaning)
    if rivals and diagnosis.verdict in CORRECTING_VERDICTS:
        undecided_text = tr(
            "Undecided: {effects} would explain these records equally well. Do "
            "not rule any of them out."
        )
        yield undecided_text.format(
            effects=join_with_or([effect_word(effect) for effect in sorted(rivals)])
        )
        if has_experiment:
            experiment_advice = tr("Press “Play next experiment …” to distinguish them.")
            advice = f"{experiment_advice} {advice}"
    yield tr("What to do: {advice}").format(advice=advice)


def describe_next_step(count: int) -> str:
    """Describe the next step with ``count`` records chosen, before the diagnosis."""
    if not count:
        return tr(FIRST_STEPS)
    count_text = tr(ONE_RECORD_CHOSEN if count == 1 else RECORDS_CHOSEN).format(n=count)
    return f"{count_text}\n{tr(HOW_TO_DIAGNOSE)}"


def make_new_motion_title(axes: tuple[str, ...]) -> str:
    """Return the name of a new motion of these axes, which checks a diagnosis."""
    return f"new motion of {join_names([get_axis_label(axis) for axis in axes])}"
