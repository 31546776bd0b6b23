"""What a verdict means to an operator, and what to do about it, in plain words; no widgets."""

from collections.abc import Iterator

from rotemina.app.display import label
from rotemina.app.shell.language import marked, translate
from rotemina.plugins.gap.words import any_of, effect_word
from rotemina.sim.gap.diagnosis import CORRECTING, AxisDiagnosis, Verdict
from rotemina.sim.messages import listed

FIRST_STEPS = marked(
    "gap",
    "1  Choose records of the real machine: files, or play a trajectory, whose record is taken.\n"
    "2  Diagnose: the program looks where the model departs from them, and why.\n"
    "3  Use the answer: add what was found to the model, check it on a new motion, keep the "
    "report.",
)
READY_ONE = marked("gap", "One record is chosen.")
READY_MORE = marked("gap", "{n} records are chosen.")
READY = marked(
    "gap",
    "Press Diagnose: the program looks where the model departs from what was measured, which effect"
    " the model lacks, and how far the gap shrinks with it. It takes about half a minute for each "
    "axis with a gap, and can be stopped at any time.",
)
NO_PROOF = marked(
    "gap",
    "This page shows how far the gap shrinks on a motion that the diagnosis has not seen.\n"
    "Press “New motion …”, or play any trajectory of the diagnosed axes.",
)

_MEANS = {
    Verdict.NONE: (
        marked("gap", "The model does what the machine does, as far as these motions show."),
        marked(
            "gap",
            "Use the model as it is. Effects that these motions do not excite are not ruled out.",
        ),
    ),
    Verdict.EXPLAINED: (
        marked(
            "gap", "The model lacks what is named below; with it, the model follows the machine."
        ),
        marked(
            "gap", "Press “Use corrected model”; then “New motion …” shows how far the gap shrinks."
        ),
    ),
    Verdict.PARTLY: (
        marked(
            "gap",
            "What is named below is present; no effect of the catalogue explains the rest of the "
            "gap.",
        ),
        marked(
            "gap",
            "Press “Use corrected model”: it follows the machine better. Look under Where what the "
            "rest depends on.",
        ),
    ),
    Verdict.UNKNOWN: (
        marked(
            "gap",
            "The gap is real, but no effect of the catalogue accounts for it. Nothing is guessed.",
        ),
        marked(
            "gap",
            "Look under Where what it depends on; check cables, clamps and sensor; record once "
            "more, "
            "slower and faster. Keep what the report says for whoever maintains the model.",
        ),
    ),
    Verdict.INSUFFICIENT: (
        marked(
            "gap",
            "These motions cannot tell one effect from another: they are too short, too small or "
            "too "
            "much alike.",
        ),
        marked(
            "gap",
            "Press “Play next experiment …”, or add records of other motions (multisine, "
            "staircase, "
            "swings), and diagnose them together.",
        ),
    ),
}


def advice(one: AxisDiagnosis, *, has_experiment: bool) -> Iterator[str]:
    """Yield what is known of an axis, what it means, and what to do."""
    means, do = (translate("gap", text) for text in _MEANS[one.verdict])
    rivals = {other for cause in one.causes for other in cause.ambiguous_with}
    yield translate("gap", "What it means: {meaning}").format(meaning=means)
    if rivals and one.verdict in CORRECTING:
        open_ = translate(
            "gap",
            "Not settled: {effects} would do as well on these records. Take the whole set as the "
            "answer.",
        )
        yield open_.format(effects=any_of([effect_word(effect) for effect in sorted(rivals)]))
        if has_experiment:
            parts = translate("gap", "Press “Play next experiment …” to tell them apart.")
            do = f"{parts} {do}"
    yield translate("gap", "What to do: {advice}").format(advice=do)


def readiness(count: int) -> str:
    """Return what to do first, or next, before there is an answer."""
    if not count:
        return translate("gap", FIRST_STEPS)
    chosen = translate("gap", READY_ONE if count == 1 else READY_MORE).format(n=count)
    ready = translate("gap", READY)
    return f"{chosen}\n{ready}"


def check_title(axes: tuple[str, ...]) -> str:
    """Return what a motion of these axes is called."""
    return f"new motion of {listed([label(axis) for axis in axes])}"
