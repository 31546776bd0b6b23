"""How good an answer is, and why a motion may show it to be worse; no widgets."""

from enum import StrEnum

from rotemina.plugins.gap import tr
from rotemina.plugins.gap.diagnosis_answer import Answer
from rotemina.plugins.gap.unseen_motion_reduction import Shrunk
from rotemina.sim.gap.diagnosis import Verdict
from rotemina.sim.records.record import Tap

_CONSTANT = 0.5  # of a gap, below which what is left without its offset is not the point
_BEYOND = 0.05  # of where records went


class Tone(StrEnum):
    """How good the news is; the style sheet has a colour for each."""

    GOOD = "good"
    PARTLY = "partly"
    NONE = "none"
    UNSURE = "unsure"
    WORSE = "worse"


TONES = {
    Verdict.NONE: Tone.NONE,
    Verdict.EXPLAINED: Tone.GOOD,
    Verdict.PARTLY: Tone.PARTLY,
    Verdict.UNKNOWN: Tone.UNSURE,
    Verdict.INSUFFICIENT: Tone.UNSURE,
}


def change(times: float) -> str:
    """Return how a gap has changed that is so many times smaller."""
    if times >= 1.0:
        return tr("{times:.3g} × smaller").format(times=times)
    return tr("{times:.3g} × larger").format(times=1.0 / max(times, 1e-300))


def why_worse(one: Shrunk, answer: Answer) -> str:
    """Return why a model may be worse on a motion, and what to do."""
    trace, figure = one.trace, one.figure
    if figure.without_offset < _CONSTANT * figure.rms:
        return tr(
            "The model is off by a constant, because the axis has a different history "
            "than in the records. Sweep its whole range once, and play the motion "
            "again."
        )
    ways = [own.signal(trace.axis, Tap.CMD) for own in answer.records if trace.axis in own.axes]
    low, high = min(float(way.min()) for way in ways), max(float(way.max()) for way in ways)
    slack = _BEYOND * (high - low)
    if trace.command.min() < low - slack or trace.command.max() > high + slack:
        return tr(
            "The motion leaves the region of the records: choose this record too, and "
            "diagnose them together."
        )
    return tr(
        "The motion differs from all records: choose this record too, and diagnose them together."
    )
