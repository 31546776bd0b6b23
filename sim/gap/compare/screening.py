"""A first look at every candidate: how much of the remainder it could remove.

Changes that the present fit could make itself are projected out, so only the candidate's own
contribution counts; then follow a few steps of descent on the candidate's parameters alone.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects import AttachedEffect, EffectStage, load_effect
from rotemina.sim.gap.compare.effect_candidates import is_slow
from rotemina.sim.gap.fit import (
    NUMERICAL,
    Evidence,
    Fit,
    bounds,
    free_parameters,
    lost,
    one_step,
    residual_of,
    starts,
    with_values,
)
from rotemina.sim.robot import AxisEffect


@dataclass(frozen=True, slots=True)
class Screened:
    """A candidate with the parameters that were found at first sight, and what it would leave."""

    effect: AxisEffect
    cost: float


def screen(evidence: Evidence, fitted: Fit, candidate: AxisEffect, *, briefly: bool) -> Screened:
    """Take a first look at a candidate: a step downhill from the best of its starts.

    A start is as good as what it takes away in the amount that suits best. ``briefly`` leaves it
    there. A candidate whose numbers fail leaves more than any other.
    """
    try:
        return _screened(evidence, fitted, candidate, briefly=briefly)
    except NUMERICAL as error:
        return Screened(candidate, lost(evidence, [candidate], error).cost)


def _screened(evidence: Evidence, fitted: Fit, candidate: AxisEffect, *, briefly: bool) -> Screened:
    quick = _without_slow_drives(evidence, fitted)
    begun = [
        _begun(evidence, fitted, quick, start) for start in starts(evidence, fitted, candidate)
    ]
    best = min(begun, key=lambda one: one.cost)
    if briefly or is_slow(evidence, candidate):
        return best
    return min(_followed(evidence, fitted, best.effect), best, key=lambda one: one.cost)


def _without_slow_drives(
    evidence: Evidence, fitted: Fit
) -> tuple[Sequence[AxisEffect], FloatArray]:
    """Return the effects beside which a candidate's change is simulated, and their residual.

    An amplifier's lag or limit takes long to simulate and hardly matters to that change.
    """
    quick = [
        one
        for one in fitted.effects
        if load_effect(one.id).stage is not EffectStage.ELECTRONICS or not is_slow(evidence, one)
    ]
    if len(quick) == len(fitted.effects):
        return quick, fitted.residual
    return quick, residual_of(evidence, quick)


def _begun(
    evidence: Evidence,
    fitted: Fit,
    quick: tuple[Sequence[AxisEffect], FloatArray],
    candidate: AxisEffect,
) -> Screened:
    """Return a start, in the amounts of what it is linear in that suit best, and what is left."""
    effects, before = quick
    names = _amounts(evidence, candidate)
    directions = _directions(evidence, candidate, names)
    changes = [
        _beside(fitted, residual_of(evidence, [*effects, one]) - before) for one in directions
    ]
    basis = np.stack(changes, axis=1)
    amounts = np.asarray(np.linalg.lstsq(basis, -fitted.beside)[0], dtype=np.float64)
    if names:
        found = _in_amounts(evidence, candidate, names, directions, amounts)
    else:
        # No parameter is an amount: the start stays, and must not go the wrong way.
        amounts = np.maximum(amounts, 0.0)
        found = candidate
    cost = float(np.mean((fitted.beside + basis @ amounts) ** 2))
    return Screened(found, cost)


def _amounts(evidence: Evidence, candidate: AxisEffect) -> list[str]:
    formulation = AttachedEffect.of(evidence.robot, candidate).formulation
    return [parameter.name for parameter in formulation.parameters if parameter.linear]


def _directions(
    evidence: Evidence, candidate: AxisEffect, names: Sequence[str]
) -> list[AxisEffect]:
    """Return a candidate in each of its amounts alone, or as it is where it has none."""
    if not names:
        return [candidate]
    values = AttachedEffect.of(evidence.robot, candidate).values
    size = max(abs(values[name]) for name in names)
    none = dict.fromkeys(names, 0.0)
    return [
        replace(candidate, parameters={**candidate.parameters, **none, name: size})
        for name in names
    ]


def _in_amounts(
    evidence: Evidence,
    candidate: AxisEffect,
    names: Sequence[str],
    directions: Sequence[AxisEffect],
    amounts: FloatArray,
) -> AxisEffect:
    attached = AttachedEffect.of(evidence.robot, candidate)
    found = dict(candidate.parameters)
    for name, one, amount in zip(names, directions, amounts, strict=True):
        parameter = attached.formulation.find_parameter(name)
        assert parameter is not None
        most = parameter.bounds(attached.facts)
        found[name] = float(np.clip(amount * one.parameters[name], *most))
    return replace(candidate, parameters=found)


def _followed(evidence: Evidence, fitted: Fit, candidate: AxisEffect) -> Screened:
    free = free_parameters(evidence, [candidate])
    low, high, start = bounds(free)

    def residual(x: FloatArray) -> FloatArray:
        effects = [*fitted.effects, *with_values([candidate], free, x)]
        return _beside(fitted, residual_of(evidence, effects))

    x, left = one_step(residual, start, low, high)
    (effect,) = with_values([candidate], free, x)
    return Screened(effect, float(np.mean(left**2)))


def _beside(fitted: Fit, residual: FloatArray) -> FloatArray:
    """Return a residual (rows,) without what the fit could do itself."""
    if not fitted.free:
        return residual
    basis = fitted.basis
    return np.asarray(residual - basis @ (basis.T @ residual))
