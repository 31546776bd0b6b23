"""Answers of two versions of the diagnosis to the same records, side by side."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, slots=True)
class EngineAnswers:
    """The answers of two versions to one case, and the processor time that each took.

    Attributes
    ----------
    case : str
        Name of the case.
    own, other : str
        The answers as from :func:`describe_answer`.
    own_processor_s, other_processor_s : float
    truth : str
        The right answer; empty if it is not known.
    """

    case: str
    own: str
    other: str
    own_processor_s: float
    other_processor_s: float
    truth: str = ""

    @property
    def differs(self) -> bool:
        """Whether verdicts, causes, their order or their sets differ."""
        return self.own != self.other

    def as_json(self) -> dict[str, Any]:
        """Return the answers as JSON."""
        return {
            "case": self.case,
            "truth": self.truth or None,
            "own": self.own,
            "other": self.other,
            "differs": self.differs,
            "own_processor_s": self.own_processor_s,
            "other_processor_s": self.other_processor_s,
        }


def describe_answer(document: Mapping[str, Any]) -> str:
    """Return verdicts and causes of a diagnosis in one line, as in ``explained: {delay} on x``.

    Probabilities and figures are left out, since they differ a little between any two versions.
    A set is sorted: which of its members comes first means nothing.
    """
    verdicts = " ".join(f"{axis}:{verdict}" for axis, verdict in document.get("axes", {}).items())
    causes = [
        f"{{{' '.join(sorted((cause['effect'], *cause.get('ambiguous_with', ()))))}}} "
        f"on {cause['axis']}"
        for cause in document.get("causes", ())
    ]
    return f"{verdicts or document['verdict']}; {', '.join(causes) or 'no cause'}"


def format_difference(answers: EngineAnswers) -> str:
    """Return the two answers to a case on two lines, or one line if they agree."""
    truth = f" (right: {answers.truth})" if answers.truth else ""
    if not answers.differs:
        return f"{answers.case}: both {answers.own}{truth}"
    return f"{answers.case}: this {answers.own}{truth}\n{answers.case}: other {answers.other}"


def format_summary(answers: Iterable[EngineAnswers]) -> str:
    """Return in how many cases two versions differ, and the processor time of each."""
    cases = list(answers)
    different = [case.case for case in cases if case.differs]
    own_s = sum(case.own_processor_s for case in cases)
    other_s = sum(case.other_processor_s for case in cases)
    ratio = f", {own_s / other_s:.2f} times as much" if other_s > 0.0 else ""
    return (
        f"{len(different)} of {len(cases)} cases differ: {', '.join(different) or 'none'}\n"
        f"processor time: this {own_s:.1f} s, other {other_s:.1f} s{ratio}"
    )
