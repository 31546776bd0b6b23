"""An answer in one line; no widgets."""

from enum import StrEnum

from rotemina.app.display import label
from rotemina.app.shell.language import marked, translate
from rotemina.plugins.gap.answer import Answer
from rotemina.plugins.gap.proof import Shrunk
from rotemina.plugins.gap.words import any_of, effect_word, within
from rotemina.sim.gap.diagnosis import Cause, Verdict
from rotemina.sim.gap.report.quantities import percent
from rotemina.sim.records.record import Tap

_CONSTANT = 0.5  # of a gap, below which what is left without its offset is not the point
_BEYOND = 0.05  # of where records went

_CALLED = {
    Verdict.NONE: marked("gap", "No gap."),
    Verdict.EXPLAINED: marked("gap", "Explained."),
    Verdict.PARTLY: marked("gap", "Explained in part."),
    Verdict.UNKNOWN: marked("gap", "Unknown gap."),
    Verdict.INSUFFICIENT: marked("gap", "Insufficient excitation."),
}


def headline(answer: Answer) -> str:
    """Return verdict and causes in one line."""
    diagnosis = answer.diagnosis
    parts = [translate("gap", _CALLED[diagnosis.verdict])]
    for name, one in diagnosis.axes.items():
        causes = [_cause(cause) for cause in one.causes]
        if causes:
            parts.append(f"{label(name)}: {', '.join(causes)}")
        elif one.verdict is not Verdict.NONE:
            called = _CALLED[one.verdict]
            shown = within(called, translate("gap", called))
            parts.append(f"{label(name)}: {shown}")
    return "   ".join(parts)


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
        return translate("gap", "{times:.3g} × smaller").format(times=times)
    return translate("gap", "{times:.3g} × larger").format(times=1.0 / max(times, 1e-300))


def why_worse(one: Shrunk, answer: Answer) -> str:
    """Return why a model may be worse on a motion, and what to do."""
    trace, figure = one.trace, one.figure
    if figure.without_offset < _CONSTANT * figure.rms:
        return translate(
            "gap",
            "It is off by a constant: the axis has a past that the records do not share. Swing it "
            "once through its range, and play the motion again.",
        )
    ways = [own.signal(trace.axis, Tap.CMD) for own in answer.records if trace.axis in own.axes]
    low, high = min(float(way.min()) for way in ways), max(float(way.max()) for way in ways)
    slack = _BEYOND * (high - low)
    if trace.command.min() < low - slack or trace.command.max() > high + slack:
        return translate(
            "gap",
            "The motion goes where no record has been: choose this record too, and diagnose them "
            "together.",
        )
    return translate(
        "gap",
        "The motion does what no record did: choose this record too, and diagnose them together.",
    )


def _cause(cause: Cause) -> str:
    names = [effect_word(effect) for effect in (cause.effect, *cause.ambiguous_with)]
    return f"{any_of(names)} {percent(cause.probability)}"
