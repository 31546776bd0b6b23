"""Scores of a diagnosis: names, sets, accusations, closure, calibration."""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind.intervals import Figure, resampled, share

SPLIT_FLOORS = 5.0
NAMING = ("explained", "partly")  # verdicts under which causes are named
_BINS = 10

Cause = tuple[str, str, str | None]


@dataclass(frozen=True, slots=True)
class Outcome:
    """One case: its opened label, the answer, how long it took, the gap that was closed.

    ``closure``: share of the gap's power that the corrected model's prediction closes on the
    record that the diagnosis never saw; None where it says nothing.
    """

    name: str
    label: Mapping[str, Any]
    answer: Mapping[str, Any]
    seconds: float
    closure: float | None = None

    @property
    def kind(self) -> str:
        """The kind of the case, from its label."""
        return str(self.label.get("kind") or _kind(self.label))

    @property
    def floors(self) -> float | None:
        """Gap in noise floors, or None if the label lacks it."""
        value = self.label.get("floors")
        return None if value is None else float(value)

    @property
    def truth(self) -> list[Cause]:
        """Axis, effect and source of each effect that is there."""
        return [cause_of(effect) for effect in self.label["effects"]]

    @property
    def there(self) -> list[Cause]:
        """What is there, whether or not the motion tells it."""
        return [*self.truth, *(cause_of(effect) for effect in self.label.get("hidden", []))]

    @property
    def named(self) -> list[Cause]:
        """Axis, effect and source of each cause that was named, the largest first."""
        return [cause_of(cause) for cause in self.answer.get("causes", [])]

    @property
    def has_remainder(self) -> bool:
        """Whether the machine also does something that no catalogue holds."""
        return self.label.get("remainder") is not None

    @property
    def has_extra(self) -> bool:
        """Whether a cause is named that is not there."""
        return bool(Counter(self.named) - Counter(self.truth))

    @property
    def verdict(self) -> str:
        """The answer's verdict."""
        return str(self.answer.get("verdict", "failed"))

    @property
    def first_right(self) -> bool:
        """Whether it is called explained, and the first cause is one that is there."""
        return self.verdict in NAMING and self.named[:1] != [] and self.named[0] in self.truth

    @property
    def exact(self) -> bool:
        """Whether the named causes are exactly the true ones."""
        return self.verdict in NAMING and Counter(self.named) == Counter(self.truth)

    @property
    def right(self) -> bool:
        """Whether verdict and causes are what the label says."""
        verdict = self.label["verdict"]
        if verdict == "explained":
            return self.exact
        return self.verdict == verdict or self.named_all_the_same

    @property
    def named_all_the_same(self) -> bool:
        """Whether exactly what is there is named, though the motion is poor."""
        there = Counter(self.there)
        return self.kind == "poor" and self.verdict in NAMING and Counter(self.named) == there

    def covered(self) -> list[bool]:
        """For each effect that is there: whether it is in a set that was named on its axis."""
        sets = [
            (cause["axis"], {cause["effect"], *cause.get("ambiguous_with", [])})
            for cause in self.answer.get("causes", [])
        ]
        return [any(a == axis and effect in s for a, s in sets) for axis, effect, _ in self.truth]


def _kind(label: Mapping[str, Any]) -> str:
    verdict = label["verdict"]
    if verdict != "explained":
        return {"none": "healthy", "insufficient_excitation": "poor"}.get(verdict, str(verdict))
    return {1: "single", 2: "double"}.get(len(label["effects"]), "triple")


def cause_of(effect: Mapping[str, Any]) -> Cause:
    """Return axis, effect and source of an entry of a label or an answer."""
    source = effect.get("from_axis") if effect["effect"] == "cross_coupling" else None
    return str(effect["axis"]), str(effect["effect"]), source


def score(outcomes: Sequence[Outcome]) -> dict[str, Figure]:
    """Return every figure of the test, each with its 95 % interval."""
    explained = [o for o in outcomes if o.label["verdict"] == "explained"]
    one = [o for o in explained if len(o.truth) == 1]
    two = [o for o in explained if len(o.truth) == 2]
    healthy = _of(outcomes, "healthy")
    figures = {
        "top_1": share([o.first_right for o in one]),
        "top_1_large_gap": share([o.first_right for o in one if _large(o)]),
        "top_1_small_gap": share([o.first_right for o in one if _small(o)]),
        "single_exact": share([o.exact for o in one]),
        "set_coverage": share([hit for o in explained for hit in o.covered()]),
        "set_size": resampled(_set_sizes(explained), _mean),
        "two_exact": share([o.exact for o in two]),
        "two_exact_large_gap": share([o.exact for o in two if _large(o)]),
        "two_exact_small_gap": share([o.exact for o in two if _small(o)]),
        "three_exact": share([o.exact for o in explained if len(o.truth) > 2]),
        "extra_causes": share([o.has_extra for o in explained]),
        "causes_named": share([o.verdict in NAMING for o in explained]),
        "false_accusations": share([o.verdict != "none" for o in healthy]),
        "unknown_recall": share([o.verdict == "unknown" for o in _of(outcomes, "unknown")]),
        "insufficient_recall": share(
            [o.verdict == "insufficient_excitation" for o in _of(outcomes, "poor")]
        ),
        "insufficient_right": share([o.right for o in _of(outcomes, "poor")]),
    }
    return figures | _continuous(outcomes, explained, healthy)


def halves(outcomes: Sequence[Outcome]) -> dict[str, list[Outcome]]:
    """Return the faulty machines without a remainder, and those with one."""
    faulty = [o for o in outcomes if o.label["verdict"] == "explained"]
    return {
        "without_remainder": [o for o in faulty if not o.has_remainder],
        "with_remainder": [o for o in faulty if o.has_remainder],
    }


def _continuous(
    outcomes: Sequence[Outcome], explained: Sequence[Outcome], healthy: Sequence[Outcome]
) -> dict[str, Figure]:
    closures = np.array([o.closure for o in explained if o.closure is not None])
    return {
        "closure_median": resampled(closures, _median),
        "closure_10th_percentile": resampled(closures, _tenth),
        "calibration_error": resampled(calibration_table(outcomes), expected_calibration_error),
        "seconds_median": resampled(np.array([o.seconds for o in outcomes]), _median),
        "seconds_greatest": resampled(np.array([o.seconds for o in outcomes]), _greatest),
        "seconds_healthy_median": resampled(np.array([o.seconds for o in healthy]), _median),
    }


def _of(outcomes: Iterable[Outcome], kind: str) -> list[Outcome]:
    return [outcome for outcome in outcomes if outcome.kind == kind]


def _large(outcome: Outcome) -> bool:
    return outcome.floors is not None and outcome.floors >= SPLIT_FLOORS


def _small(outcome: Outcome) -> bool:
    return outcome.floors is not None and outcome.floors < SPLIT_FLOORS


def _set_sizes(outcomes: Iterable[Outcome]) -> FloatArray:
    causes = [cause for o in outcomes for cause in o.answer.get("causes", [])]
    return np.array([1.0 + len(cause.get("ambiguous_with", [])) for cause in causes])


def calibration_table(outcomes: Iterable[Outcome]) -> FloatArray:
    """Return (c, 2): the probability of every cause that was named, and 1 if it is there."""
    rows = [
        (float(cause["probability"]), float(named in outcome.there))
        for outcome in outcomes
        for cause, named in zip(outcome.answer.get("causes", []), outcome.named, strict=True)
        if cause.get("probability") is not None
    ]
    return np.array(rows, dtype=np.float64).reshape(-1, 2)


def expected_calibration_error(table: FloatArray) -> float:
    """Return Σ nᵦ/n |mean probability − share that is right| over ten bins (Naeini et al. 2015)."""
    bins = np.minimum((table[:, 0] * _BINS).astype(int), _BINS - 1)
    gaps = [
        np.sum(bins == b) * abs(float(np.diff(table[bins == b].mean(axis=0))[0]))
        for b in np.unique(bins)
    ]
    return float(np.sum(gaps) / len(table))


def confusion(outcomes: Iterable[Outcome]) -> dict[tuple[str, str], int]:
    """Count pairs (true effect, effect named first) over cases with at most one effect."""
    counts: Counter[tuple[str, str]] = Counter()
    for outcome in outcomes:
        if len(outcome.truth) > 1:
            continue
        verdict = outcome.label["verdict"]
        truth = outcome.truth[0][1] if verdict == "explained" else str(verdict)
        told = outcome.verdict
        if told in NAMING and outcome.named:
            told = outcome.named[0][1]
        counts[truth, told] += 1
    return dict(counts)


def _statistic(function: Callable[..., Any], *numbers: float) -> Callable[[FloatArray], float]:
    return lambda values: float(function(values, *numbers))


_mean, _median, _greatest = _statistic(np.mean), _statistic(np.median), _statistic(np.max)
_tenth = _statistic(np.percentile, 10.0)
