"""Hysteresis of a piezo: the way up is not the way down, whatever the pace."""

import numpy as np

from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import (
    Drive,
    Effect,
    Formulation,
    Parameter,
    Stage,
    Trait,
    Values,
)

PLAYS = 10


def play_operators(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = w₀ x + Σ wᵢ Pᵢ(x)``; play ``Pᵢ = max(x − rᵢ, min(x + rᵢ, Pᵢ))``, from the low end.

    p: x₀, w₀, then r and w of each play.
    """
    x -= p[0]
    y = p[1] * x
    for i in range(PLAYS):
        s[i] = max(x - p[2 + i], min(x + p[2 + i], s[i]))
        y += p[2 + PLAYS + i] * s[i]
    return p[0] + y


def _spread(values: Values, facts: Facts) -> tuple[float, ...]:
    """Place thresholds evenly up to half the range; shape the weights to the asked width.

    A loop from end to end is widest where it is half way. A play of threshold r is 2 r wide there
    (r up to half the range), so the weights, growing as ``r^(shape − 1)``, are scaled for
    ``width = Σ wᵢ 2 rᵢ``. The gain from end to end stays 1.
    """
    thresholds = 0.5 * facts.span * (np.arange(PLAYS) + 0.5) / PLAYS
    weights = (thresholds / facts.span) ** (values["shape"] - 1.0)
    weights *= values["width"] / float(np.sum(2.0 * thresholds * weights))
    rise = facts.span * (1.0 - float(weights.sum())) + float(np.sum(2.0 * thresholds * weights))
    return (facts.low, rise / facts.span, *thresholds, *weights)


HYSTERESIS = Effect(
    id="hysteresis",
    title="Hysteresis",
    summary="Loops whose width grows faster than their amplitude, at any pace; odd distortion.",
    stage=Stage.ACTUATOR,
    kinds=frozenset({"piezo"}),
    formulations=(
        Formulation(
            name="prandtl_ishlinskii",
            equation="y = w₀ x + Σ wᵢ Pᵢ(x), Pᵢ = max(x − rᵢ, min(x + rᵢ, Pᵢ)), i = 1…10",
            source="Kuhnen, European Journal of Control 9 (2003) 407–418",
            parameters=(
                Parameter("width", "of the loop from end to end", "q", 0.0, 0.5, 0.1, per="span"),
                Parameter(
                    "shape", "1: all plays weigh the same; more: wide ones do", "", 0.5, 4.0, 1.0
                ),
            ),
            acts=Drive(step=play_operators, states=PLAYS),
            prepare=_spread,
            traits=frozenset({Trait.RATE_INDEPENDENT, Trait.DISSIPATIVE}),
        ),
    ),
)
