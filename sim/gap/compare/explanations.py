"""Explanations of an axis' gap: causes, fitted together with the model's own parameters."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.fit import Evidence, Fit, baseline, fit, held_out
from rotemina.sim.records import Tap
from rotemina.sim.robot import AxisEffect

MOST_STEPS = 9


@dataclass(frozen=True, eq=False)
class Explanation:
    """Causes, and how well they do.

    Attributes
    ----------
    causes : tuple of AxisEffect
        As fitted.
    fit : Fit
        Of the causes and then of the model's own parameters, as far as they are no causes.
    held_out : (rows,)
        What is left of each record by a fit to the others.
    by_tap : mapping of Tap to float
        Its mean square over the floor, tap by tap.
    """

    causes: tuple[AxisEffect, ...]
    fit: Fit
    held_out: FloatArray
    by_tap: Mapping[Tap, float]

    @cached_property
    def score(self) -> float:
        """Mean square over the floor, on data that the fit did not see."""
        return float(np.mean(self.held_out**2))

    @property
    def ids(self) -> tuple[tuple[str, str | None], ...]:
        """The effects, each with the axis that it comes from."""
        return tuple(sorted((cause.id, cause.from_axis) for cause in self.causes))


def explain(
    evidence: Evidence, causes: Sequence[AxisEffect], *, most_steps: int = MOST_STEPS
) -> Explanation:
    """Fit causes, from the parameters that they name on, together with the model's own."""
    fitted = fit(evidence, beside(evidence, causes), most_steps=most_steps)
    return explanation(evidence, len(causes), fitted)


def explanation(evidence: Evidence, causes: int, fitted: Fit) -> Explanation:
    """Judge a fit whose first few effects are causes on data that it did not see."""
    left = held_out(evidence, fitted)
    return Explanation(fitted.effects[:causes], fitted, left, mean_squares(evidence, left))


def counted_in(shown: Evidence, evidence: Evidence, one: Explanation) -> Explanation:
    """Return an explanation with what it leaves as that counts in other evidence.

    Both are of the same records; only the weights of their rows differ.
    """
    if shown is evidence:
        return one
    left = held_out(evidence, one.fit, shown)
    return replace(one, held_out=left, by_tap=mean_squares(shown, left))


def named_as(one: Explanation, ids: Collection[tuple[str, str | None]]) -> Explanation:
    """Return an explanation with those of its effects as causes, the others as corrections."""
    return replace(
        one, causes=tuple(own for own in one.fit.effects if (own.id, own.from_axis) in ids)
    )


def untouched(evidence: Evidence) -> Explanation:
    """Return the original model, with the possible changes of its own parameters."""
    bare = fit(evidence, beside(evidence, ()), most_steps=0)
    return Explanation((), bare, bare.residual, mean_squares(evidence, bare.residual))


def mean_squares(evidence: Evidence, left: FloatArray) -> dict[Tap, float]:
    """Return the mean square of a residual (rows,), tap by tap."""
    rows: dict[Tap, list[slice]] = {}
    for part in evidence.parts:
        rows.setdefault(part.tap, []).append(part.rows)
    return {
        tap: float(np.mean(np.concatenate([left[one] for one in own]) ** 2))
        for tap, own in rows.items()
    }


def beside(
    evidence: Evidence, causes: Sequence[AxisEffect], begun: Explanation | None = None
) -> list[AxisEffect]:
    """Return causes, and the model's own parameters as far as they are not among them.

    These are as they were ``begun`` with, else as the model has them.
    """
    named = {cause.id for cause in causes}
    tuned = begun.fit.effects[len(begun.causes) :] if begun else ()
    found = {(one.id, one.formulation): one for one in (*baseline(evidence), *tuned)}
    return [*causes, *(own for own in found.values() if own.id not in named)]
