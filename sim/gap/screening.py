"""A first look at every candidate: how much of what is left it could take away.

What the fit so far could do itself by changing its parameters is projected out, so that only what
a candidate adds counts; then a few steps of descent on the candidate's parameters alone.
"""

from dataclasses import dataclass
from math import isfinite

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects.attachment import Attached
from rotemina.sim.gap.descent import descend
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.gap.fit import Fit, bounds, free_parameters, with_values
from rotemina.sim.gap.starts import starts
from rotemina.sim.robot.model import AxisEffect

_STEPS = 2


@dataclass(frozen=True, slots=True)
class Screened:
    """A candidate with the parameters that were found at first sight, and what it would leave."""

    effect: AxisEffect
    cost: float


def screen(evidence: Evidence, fitted: Fit, candidate: AxisEffect) -> Screened:
    """Take a first look at a candidate: follow it downhill from the best of its starts.

    A start is as good as what it takes away in the amount that suits best. What takes long to
    simulate is left at its best start.
    """
    begun = [_Begun.of(evidence, fitted, start) for start in starts(evidence, fitted, candidate)]
    best = min(begun, key=lambda one: one.promise)
    return best.followed(evidence, fitted, 0 if _is_slow(evidence, candidate) else _STEPS)


def _is_slow(evidence: Evidence, candidate: AxisEffect) -> bool:
    attached = Attached.of(evidence.robot, candidate)
    return bool(isfinite(attached.formulation.inner_step_s(attached.values, attached.facts)))


@dataclass(frozen=True, slots=True, eq=False)
class _Begun:
    """A start: ``beside`` projects out what the fit could do itself."""

    candidate: AxisEffect
    promise: float

    @classmethod
    def of(cls, evidence: Evidence, fitted: Fit, candidate: AxisEffect) -> "_Begun":
        left = _beside(fitted, fitted.residual)
        change = _beside(fitted, evidence.residual([*fitted.effects, candidate]) - fitted.residual)
        power = float(change @ change)
        taken = max(-float(change @ left), 0.0) ** 2 / power if power > 0.0 else 0.0
        return cls(candidate, float(left @ left) - taken)

    def followed(self, evidence: Evidence, fitted: Fit, steps: int) -> Screened:
        if steps == 0:
            return Screened(self.candidate, self.promise / len(fitted.residual))
        free = free_parameters(evidence, [self.candidate])
        low, high, start = bounds(free)

        def residual(x: FloatArray) -> FloatArray:
            effects = [*fitted.effects, *with_values([self.candidate], free, x)]
            return _beside(fitted, evidence.residual(effects))

        found = descend(residual, start, low, high, steps)
        (effect,) = with_values([self.candidate], free, found.x)
        return Screened(effect, float(np.mean(found.residual**2)))


def _beside(fitted: Fit, residual: FloatArray) -> FloatArray:
    """Return a residual (rows,) without what the fit could do itself."""
    if not fitted.free:
        return residual
    basis = fitted.basis
    return np.asarray(residual - basis @ (basis.T @ residual))
