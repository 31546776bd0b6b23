"""Explanations of an axis' gap: causes, fitted together with the model's own parameters."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.baseline import baseline
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.gap.fit import Fit, fit, held_out
from rotemina.sim.robot.model import AxisEffect


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
    """

    causes: tuple[AxisEffect, ...]
    fit: Fit
    held_out: FloatArray

    @cached_property
    def score(self) -> float:
        """Mean square over the floor, on data that the fit did not see."""
        return float(np.mean(self.held_out**2))

    @property
    def ids(self) -> tuple[tuple[str, str | None], ...]:
        """The effects, each with the axis that it comes from."""
        return tuple(sorted((cause.id, cause.from_axis) for cause in self.causes))


def explain(
    evidence: Evidence, causes: Sequence[AxisEffect], *, most_steps: int = 12
) -> Explanation:
    """Fit causes, from the parameters that they name on, together with the model's own."""
    fitted = fit(evidence, beside(evidence, causes), most_steps=most_steps)
    return Explanation(fitted.effects[: len(causes)], fitted, held_out(evidence, fitted))


def beside(evidence: Evidence, causes: Sequence[AxisEffect]) -> list[AxisEffect]:
    """Return causes, and the model's own parameters as far as they are not among them."""
    named = {cause.id for cause in causes}
    return [*causes, *(own for own in baseline(evidence) if own.id not in named)]
