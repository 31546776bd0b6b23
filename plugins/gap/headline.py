"""An answer in one line; no widgets."""

from rotemina.app.display import label
from rotemina.app.shell.language import marked, translate
from rotemina.plugins.gap.answer import Answer
from rotemina.plugins.gap.words import any_of, effect_word, within
from rotemina.sim.gap.diagnosis import Cause, Verdict
from rotemina.sim.gap.report.quantities import percent

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


def _cause(cause: Cause) -> str:
    names = [effect_word(effect) for effect in (cause.effect, *cause.ambiguous_with)]
    return f"{any_of(names)} {percent(cause.probability)}"
