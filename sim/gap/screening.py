"""A first look at every candidate: how much of what is left it could take away.

What the fit so far could do itself by changing its parameters is projected out, so that only what
a candidate adds counts; then a few steps of descent on the candidate's parameters alone.
"""

from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.candidates import is_slow
from rotemina.sim.gap.descent import one_step
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.gap.fit import Fit, bounds, free_parameters, with_values
from rotemina.sim.gap.starts import starts
from rotemina.sim.robot.model import AxisEffect


@dataclass(frozen=True, slots=True)
class Screened:
    """A candidate with the parameters that were found at first sight, and what it would leave."""

    effect: AxisEffect
    cost: float


def screen(evidence: Evidence, fitted: Fit, candidate: AxisEffect, *, briefly: bool) -> Screened:
    """Take a first look at a candidate: a step downhill from the best of its starts.

    A start is as good as what it takes away in the amount that suits best. ``briefly`` leaves it
    there.
    """
    begun = [_begun(evidence, fitted, start) for start in starts(evidence, fitted, candidate)]
    best = min(begun, key=lambda one: one.cost)
    if briefly or is_slow(evidence, candidate):
        return best
    return min(_followed(evidence, fitted, best.effect), best, key=lambda one: one.cost)


def _begun(evidence: Evidence, fitted: Fit, candidate: AxisEffect) -> Screened:
    change = evidence.residual([*fitted.effects, candidate]) - fitted.residual
    change = _beside(fitted, change)
    power = float(change @ change)
    taken = max(-float(change @ fitted.beside), 0.0) ** 2 / power if power > 0.0 else 0.0
    cost = float(fitted.beside @ fitted.beside) - taken
    return Screened(candidate, cost / len(change))


def _followed(evidence: Evidence, fitted: Fit, candidate: AxisEffect) -> Screened:
    free = free_parameters(evidence, [candidate])
    low, high, start = bounds(free)

    def residual(x: FloatArray) -> FloatArray:
        effects = [*fitted.effects, *with_values([candidate], free, x)]
        return _beside(fitted, evidence.residual(effects))

    x, left = one_step(residual, start, low, high)
    (effect,) = with_values([candidate], free, x)
    return Screened(effect, float(np.mean(left**2)))


def _beside(fitted: Fit, residual: FloatArray) -> FloatArray:
    """Return a residual (rows,) without what the fit could do itself."""
    if not fitted.free:
        return residual
    basis = fitted.basis
    return np.asarray(residual - basis @ (basis.T @ residual))
