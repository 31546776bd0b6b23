"""What a verdict means to an operator, and what to do about it, in plain words; no widgets."""

from collections.abc import Iterator

from rotemina.app.display_units import label
from rotemina.plugins.gap import mark, tr
from rotemina.plugins.gap.words import any_of, effect_word
from rotemina.sim.gap.diagnosis import CORRECTING, AxisDiagnosis, Verdict
from rotemina.sim.messages import listed

FIRST_STEPS = mark(
    "1  Choose records of the real machine: choose files, or play a trajectory "
    "and use its record.\n2  Diagnose: find where and why the model differs from"
    " the records.\n3  Use the answer: add the causes to the model, check it "
    "with a new motion, keep the report."
)
READY_ONE = mark("One record is chosen.")
READY_MORE = mark("{n} records are chosen.")
READY = mark(
    "Press Diagnose to find where the model differs from the measurements, "
    "which effect it lacks, and how far the gap shrinks with that effect. This "
    "takes about half a minute for each axis with a gap; you can stop it at any"
    " time."
)
NO_PROOF = mark(
    "This page shows how far the gap shrinks on a motion that the diagnosis has not seen.\n"
    "Press “New motion …”, or play any trajectory of the diagnosed axes."
)

_MEANS = {
    Verdict.NONE: (
        mark("The model matches the machine in these motions."),
        mark("Use the model as it is. Effects that these motions do not excite are not ruled out."),
    ),
    Verdict.EXPLAINED: (
        mark("The model lacks the effects named below; with them, it follows the machine."),
        mark("Press “Use corrected model”; then “New motion …” shows how far the gap shrinks."),
    ),
    Verdict.PARTLY: (
        mark(
            "The effects named below are present; no effect of the catalogue explains "
            "the rest of the gap."
        ),
        mark(
            "Press “Use corrected model”: it follows the machine better. The page Where"
            " shows what the rest depends on."
        ),
    ),
    Verdict.UNKNOWN: (
        mark("The gap is real, but no effect of the catalogue explains it."),
        mark(
            "The page Where shows what it depends on. Check cables, clamps and sensor; "
            "record again, slower and faster. Keep the report for the maintainer of the"
            " model."
        ),
    ),
    Verdict.INSUFFICIENT: (
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


def advice(one: AxisDiagnosis, *, has_experiment: bool) -> Iterator[str]:
    """Yield what is known of an axis, what it means, and what to do."""
    means, do = (tr(text) for text in _MEANS[one.verdict])
    rivals = {other for cause in one.causes for other in cause.ambiguous_with}
    yield tr("What it means: {meaning}").format(meaning=means)
    if rivals and one.verdict in CORRECTING:
        open_ = tr(
            "Undecided: {effects} would explain these records equally well. Take the "
            "whole set as the answer."
        )
        yield open_.format(effects=any_of([effect_word(effect) for effect in sorted(rivals)]))
        if has_experiment:
            parts = tr("Press “Play next experiment …” to distinguish them.")
            do = f"{parts} {do}"
    yield tr("What to do: {advice}").format(advice=do)


def readiness(count: int) -> str:
    """Return what to do first, or next, before there is an answer."""
    if not count:
        return tr(FIRST_STEPS)
    chosen = tr(READY_ONE if count == 1 else READY_MORE).format(n=count)
    ready = tr(READY)
    return f"{chosen}\n{ready}"


def check_title(axes: tuple[str, ...]) -> str:
    """Return what a motion of these axes is called."""
    return f"new motion of {listed([label(axis) for axis in axes])}"
