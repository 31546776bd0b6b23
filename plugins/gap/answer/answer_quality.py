"""Quality of an answer, and why a model may be worse on a motion. Does not use Qt."""

from enum import StrEnum

from rotemina.plugins.gap import tr
from rotemina.plugins.gap.answer.diagnosis_answer import DiagnosisAnswer
from rotemina.plugins.gap.answer.unseen_motion_reduction import GapReduction
from rotemina.sim.gap.result import GapVerdict
from rotemina.sim.records import Tap

# If removing the offset reduces the rms of a gap to less than this fraction, the gap is mainly an
# offset.
_MAX_OFFSET_FREE_RATIO = 0.5

# A motion may leave the range of the records by this fraction of that range before it counts as
# outside.
_RANGE_SLACK_RATIO = 0.05


class AnswerTone(StrEnum):
    """Quality of an answer; the style sheet has a colour for each value."""

    GOOD = "good"
    PARTLY = "partly"
    NONE = "none"
    UNSURE = "unsure"
    WORSE = "worse"


VERDICT_TONES = {
    GapVerdict.NONE: AnswerTone.NONE,
    GapVerdict.EXPLAINED: AnswerTone.GOOD,
    GapVerdict.PARTLY: AnswerTone.PARTLY,
    GapVerdict.UNKNOWN: AnswerTone.UNSURE,
    GapVerdict.INSUFFICIENT: AnswerTone.UNSURE,
    GapVerdict.FAILED: AnswerTone.UNSURE,
}


def describe_change(times: float) -> str:
    """Describe the change of a gap that has become smaller by the factor ``times``."""
    if times >= 1.0:
        return tr("{times:.3g} × smaller").format(times=times)
    return tr("{times:.3g} × larger").format(times=1.0 / max(times, 1e-300))


def explain_gap_increase(reduction: GapReduction, answer: DiagnosisAnswer) -> str:
    """Explain why the correction may increase the gap on a motion, and what to do."""
    trace, gap = reduction.trace, reduction.figure
    if gap.without_offset < _MAX_OFFSET_FREE_RATIO * gap.rms:
        return tr(
            "The model is off by a constant, because the axis has a different history "
            "than in the records. Sweep its whole range once, and play the motion "
            "again."
        )
    commands = [
        record.signal(trace.axis, Tap.CMD) for record in answer.records if trace.axis in record.axes
    ]
    low, high = (
        min(float(command.min()) for command in commands),
        max(float(command.max()) for command in commands),
    )
    slack = _RANGE_SLACK_RATIO * (high - low)
    if trace.command.min() < low - slack or trace.command.max() > high + slack:
        return tr(
            "The motion leaves the region of the records: choose this record too, and "
            "diagnose them together."
        )
    return tr(
        "The motion differs from all records: choose this record too, and diagnose them together."
    )
