"""An answer in one line. Free of Qt."""

from rotemina.app.display import label
from rotemina.plugins.gap.answer import Answer
from rotemina.sim.gap.diagnosis import Cause, Verdict
from rotemina.sim.gap.report.quantities import percent
from rotemina.sim.gap.report.words import effect_title, listed

_CALLED = {
    Verdict.NONE: "No gap.",
    Verdict.EXPLAINED: "Explained.",
    Verdict.UNKNOWN: "Unknown gap.",
    Verdict.INSUFFICIENT: "Insufficient excitation.",
}


def headline(answer: Answer) -> str:
    """Return verdict and causes in one line."""
    diagnosis = answer.diagnosis
    parts = [_CALLED[diagnosis.verdict]]
    for name, one in diagnosis.axes.items():
        causes = [_cause(cause) for cause in one.causes]
        if causes:
            parts.append(f"{label(name)}: {', '.join(causes)}")
        elif one.verdict is not Verdict.NONE:
            parts.append(f"{label(name)}: {_CALLED[one.verdict].lower()}")
    return "   ".join(parts)


def _cause(cause: Cause) -> str:
    names = [effect_title(effect).lower() for effect in (cause.effect, *cause.ambiguous_with)]
    return f"{listed(names, 'or')} {percent(cause.probability)}"
