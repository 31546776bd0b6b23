"""Scores of a diagnosis: named causes, sets of alternatives, false alarms, closure, calibration."""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind.confidence_intervals import (
    IntervalEstimate,
    estimate_by_bootstrap,
    estimate_share,
)

# Gaps of at least this size count as large.
LARGE_GAP_FLOORS = 5.0
# Verdicts of a diagnosis that names causes.
NAMING_VERDICTS = ("explained", "partly")
_BIN_COUNT = 10

# Axis, effect, and source axis of a cross-coupling (otherwise None).
Cause = tuple[str, str, str | None]


@dataclass(frozen=True, slots=True)
class CaseOutcome:
    """The outcome of one case.

    Attributes
    ----------
    name : name of the case.
    label : label with the true effects, opened after the diagnosis.
    answer : answer of the diagnosis.
    seconds : duration of the diagnosis, s.
    closure : float or None
        Fraction of the gap's power that the corrected model removes on the held-out record. None
        if it cannot be computed.
    """

    name: str
    label: Mapping[str, Any]
    answer: Mapping[str, Any]
    seconds: float
    closure: float | None = None

    @property
    def kind(self) -> str:
        """The kind of the case, from its label."""
        return str(self.label.get("kind") or _get_kind(self.label))

    @property
    def floors(self) -> float | None:
        """The gap in noise floors, or None if the label does not contain it."""
        value = self.label.get("floors")
        return None if value is None else float(value)

    @property
    def true_causes(self) -> list[Cause]:
        """Axis, effect and source of each true effect in the label."""
        return [make_cause(effect) for effect in self.label["effects"]]

    @property
    def present_causes(self) -> list[Cause]:
        """The true effects, including those that poor excitation hides."""
        return [*self.true_causes, *(make_cause(effect) for effect in self.label.get("hidden", []))]

    @property
    def named_causes(self) -> list[Cause]:
        """Axis, effect and source of each named cause, the largest first."""
        return [make_cause(cause) for cause in self.answer.get("causes", [])]

    @property
    def has_remainder(self) -> bool:
        """Whether the machine also has a remainder, which no effect explains."""
        return self.label.get("remainder") is not None

    @property
    def has_extra(self) -> bool:
        """Whether a named cause is not among the true ones."""
        return bool(Counter(self.named_causes) - Counter(self.true_causes))

    @property
    def verdict(self) -> str:
        """The verdict of the answer."""
        return str(self.answer.get("verdict", "failed"))

    @property
    def is_first_correct(self) -> bool:
        """Whether causes are named and the first one is a true effect."""
        return (
            self.verdict in NAMING_VERDICTS
            and self.named_causes[:1] != []
            and self.named_causes[0] in self.true_causes
        )

    @property
    def is_exact(self) -> bool:
        """Whether the named causes are exactly the true ones."""
        return self.verdict in NAMING_VERDICTS and Counter(self.named_causes) == Counter(
            self.true_causes
        )

    @property
    def is_correct(self) -> bool:
        """Whether verdict and causes are correct according to the label."""
        verdict = self.label["verdict"]
        if verdict == "explained":
            return self.is_exact
        return self.verdict == verdict or self.is_named_despite_poor_motion

    @property
    def is_named_despite_poor_motion(self) -> bool:
        """Whether the exact causes are named despite poor excitation."""
        present = Counter(self.present_causes)
        return (
            self.kind == "poor"
            and self.verdict in NAMING_VERDICTS
            and Counter(self.named_causes) == present
        )

    def check_coverage(self) -> list[bool]:
        """Return for each true effect whether a cause named on its axis allows for it."""
        sets = [
            (cause["axis"], {cause["effect"], *cause.get("ambiguous_with", [])})
            for cause in self.answer.get("causes", [])
        ]
        return [
            any(a == axis and effect in s for a, s in sets) for axis, effect, _ in self.true_causes
        ]


def _get_kind(label: Mapping[str, Any]) -> str:
    verdict = label["verdict"]
    if verdict != "explained":
        return {"none": "healthy", "insufficient_excitation": "poor"}.get(verdict, str(verdict))
    return {1: "single", 2: "double"}.get(len(label["effects"]), "triple")


def make_cause(effect: Mapping[str, Any]) -> Cause:
    """Return axis, effect and source of an entry of a label or an answer."""
    source = effect.get("from_axis") if effect["effect"] == "cross_coupling" else None
    return str(effect["axis"]), str(effect["effect"]), source


def score(outcomes: Sequence[CaseOutcome]) -> dict[str, IntervalEstimate]:
    """Return all figures of the test, each with its 95 % interval."""
    explained = [o for o in outcomes if o.label["verdict"] == "explained"]
    singles = [o for o in explained if len(o.true_causes) == 1]
    doubles = [o for o in explained if len(o.true_causes) == 2]
    healthy = _select_kind(outcomes, "healthy")
    figures = {
        "top_1": estimate_share([o.is_first_correct for o in singles]),
        "top_1_large_gap": estimate_share(
            [o.is_first_correct for o in singles if _has_large_gap(o)]
        ),
        "top_1_small_gap": estimate_share(
            [o.is_first_correct for o in singles if _has_small_gap(o)]
        ),
        "single_exact": estimate_share([o.is_exact for o in singles]),
        "set_coverage": estimate_share([hit for o in explained for hit in o.check_coverage()]),
        "set_size": estimate_by_bootstrap(_count_set_sizes(explained), _compute_mean),
        "two_exact": estimate_share([o.is_exact for o in doubles]),
        "two_exact_large_gap": estimate_share([o.is_exact for o in doubles if _has_large_gap(o)]),
        "two_exact_small_gap": estimate_share([o.is_exact for o in doubles if _has_small_gap(o)]),
        "three_exact": estimate_share([o.is_exact for o in explained if len(o.true_causes) > 2]),
        "extra_causes": estimate_share([o.has_extra for o in explained]),
        "causes_named": estimate_share([o.verdict in NAMING_VERDICTS for o in explained]),
        "false_accusations": estimate_share([o.verdict != "none" for o in healthy]),
        "unknown_recall": estimate_share(
            [o.verdict == "unknown" for o in _select_kind(outcomes, "unknown")]
        ),
        "insufficient_recall": estimate_share(
            [o.verdict == "insufficient_excitation" for o in _select_kind(outcomes, "poor")]
        ),
        "insufficient_right": estimate_share(
            [o.is_correct for o in _select_kind(outcomes, "poor")]
        ),
    }
    return figures | _score_continuous(outcomes, explained, healthy)


def split_by_remainder(outcomes: Sequence[CaseOutcome]) -> dict[str, list[CaseOutcome]]:
    """Return the faulty machines without a remainder, and those with one."""
    faulty = [o for o in outcomes if o.label["verdict"] == "explained"]
    return {
        "without_remainder": [o for o in faulty if not o.has_remainder],
        "with_remainder": [o for o in faulty if o.has_remainder],
    }


def _score_continuous(
    outcomes: Sequence[CaseOutcome],
    explained: Sequence[CaseOutcome],
    healthy: Sequence[CaseOutcome],
) -> dict[str, IntervalEstimate]:
    closures = np.array([o.closure for o in explained if o.closure is not None])
    return {
        "closure_median": estimate_by_bootstrap(closures, _compute_median),
        "closure_10th_percentile": estimate_by_bootstrap(closures, _compute_tenth_percentile),
        "calibration_error": estimate_by_bootstrap(
            make_calibration_table(outcomes), compute_calibration_error
        ),
        "seconds_median": estimate_by_bootstrap(
            np.array([o.seconds for o in outcomes]), _compute_median
        ),
        "seconds_greatest": estimate_by_bootstrap(
            np.array([o.seconds for o in outcomes]), _compute_maximum
        ),
        "seconds_healthy_median": estimate_by_bootstrap(
            np.array([o.seconds for o in healthy]), _compute_median
        ),
    }


def _select_kind(outcomes: Iterable[CaseOutcome], kind: str) -> list[CaseOutcome]:
    return [outcome for outcome in outcomes if outcome.kind == kind]


def _has_large_gap(outcome: CaseOutcome) -> bool:
    return outcome.floors is not None and outcome.floors >= LARGE_GAP_FLOORS


def _has_small_gap(outcome: CaseOutcome) -> bool:
    return outcome.floors is not None and outcome.floors < LARGE_GAP_FLOORS


def _count_set_sizes(outcomes: Iterable[CaseOutcome]) -> FloatArray:
    causes = [cause for o in outcomes for cause in o.answer.get("causes", [])]
    return np.array([1.0 + len(cause.get("ambiguous_with", [])) for cause in causes])


def make_calibration_table(outcomes: Iterable[CaseOutcome]) -> FloatArray:
    """Return (c, 2): the probability of each named cause, and 1 if it is a true cause, else 0."""
    rows = [
        (float(cause["probability"]), float(cause_key in outcome.present_causes))
        for outcome in outcomes
        for cause, cause_key in zip(
            outcome.answer.get("causes", []), outcome.named_causes, strict=True
        )
        if cause.get("probability") is not None
    ]
    return np.array(rows, dtype=np.float64).reshape(-1, 2)


def compute_calibration_error(table: FloatArray) -> float:
    """Return the expected calibration error over ten bins (Naeini et al. 2015).

    It is ``Σ nᵦ/n |mean probability − share of true causes|``.
    """
    bins = np.minimum((table[:, 0] * _BIN_COUNT).astype(int), _BIN_COUNT - 1)
    gaps = [
        np.sum(bins == b) * abs(float(np.diff(table[bins == b].mean(axis=0))[0]))
        for b in np.unique(bins)
    ]
    return float(np.sum(gaps) / len(table))


def count_confusion(outcomes: Iterable[CaseOutcome]) -> dict[tuple[str, str], int]:
    """Count pairs (true effect, effect named first) over cases with at most one effect."""
    counts: Counter[tuple[str, str]] = Counter()
    for outcome in outcomes:
        if len(outcome.true_causes) > 1:
            continue
        verdict = outcome.label["verdict"]
        truth = outcome.true_causes[0][1] if verdict == "explained" else str(verdict)
        answer = outcome.verdict
        if answer in NAMING_VERDICTS and outcome.named_causes:
            answer = outcome.named_causes[0][1]
        counts[truth, answer] += 1
    return dict(counts)


def _make_statistic(
    function: Callable[..., Any], *arguments: float
) -> Callable[[FloatArray], float]:
    return lambda values: float(function(values, *arguments))


_compute_mean, _compute_median, _compute_maximum = (
    _make_statistic(np.mean),
    _make_statistic(np.median),
    _make_statistic(np.max),
)
_compute_tenth_percentile = _make_statistic(np.percentile, 10.0)
