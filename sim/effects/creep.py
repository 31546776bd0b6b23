"""Creep of a piezo: motion continues after a move, by the same amount in each decade of time."""

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
from rotemina.sim.effects.identification import Identification
from rotemina.sim.effects.kinship import Family, Kinship
from rotemina.sim.effects.starts import sizes

TERMS = 12
_SPACING = 1.45  # logarithm of the ratio of neighbouring rates
_LONG_S = 1e8  # longer than any run: the way to the start
_SAME = 1e-9  # relative difference of times that rounding makes

# Places of the memory behind that of the terms.
_START, _LASTED, _FASTEST = TERMS, TERMS + 1, TERMS + 2
_MOVED, _MEAN = TERMS + 3, 2 * TERMS + 3
_STATES = 3 * TERMS + 3


def relaxations(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = x + Σ wᵢ (zᵢ − x₀)``, ``τᵢ żᵢ = x − zᵢ``, from rest at x₀.

    p: τᵢ, then wᵢ. s: zᵢ, x₀, then the previous h and τ₀, and the values computed from them: for
    each term the share of its distance that it moves in a step, and its mean.
    """
    if h > _LONG_S:
        s[_START] = x
        for i in range(TERMS):
            s[i] = x
        return x
    y = x
    if h == 0.0:
        for i in range(TERMS):
            y += p[TERMS + i] * (s[i] - s[_START])
        return y
    if abs(h - s[_LASTED]) > _SAME * h or p[0] != s[_FASTEST]:
        s[_LASTED], s[_FASTEST] = h, p[0]
        for i in range(TERMS):
            s[_MOVED + i] = -np.expm1(-h / p[i])
            s[_MEAN + i] = 1.0 - s[_MOVED + i] * p[i] / h
    for i in range(TERMS):
        way = x - s[i]
        y += p[TERMS + i] * (s[i] + s[_MEAN + i] * way - s[_START])
        s[i] += s[_MOVED + i] * way
    return y


def _terms(values: Values, _facts: Facts) -> tuple[float, ...]:
    """Place the terms evenly in the logarithm of their rate.

    ``ln(1 + t/t₀) = ∫ (1 − exp(−σt/t₀)) exp(−σ)/σ dσ``, by the trapezoidal rule in ln σ, which
    converges exponentially. The slowest term also replaces all slower ones, which would move
    linearly. Within 0.2 % of a decade up to 2·10⁵ t₀, and 2 % up to 10⁶ t₀.
    """
    rates = np.exp(_SPACING * (1.0 - np.arange(TERMS)))
    weights = _SPACING * np.exp(-rates)
    weights[-1] /= -np.expm1(-_SPACING)
    weights *= values["rate"] / np.log(10.0)
    return (*(values["onset"] / rates), *weights)


CREEP = Effect(
    id="creep",
    title="Creep",
    summary="Motion continues after a move, proportional to it, with the logarithm of time.",
    stage=Stage.ACTUATOR,
    kinds=frozenset({"piezo"}),
    identification=Identification(starts=sizes(onset=(0.3, 3.0))),
    kinship=Kinship(family=Family.CREEP, brings_along={Family.DRIFT: 0.1}),
    formulations=(
        Formulation(
            name="logarithmic",
            equation="y = x + γ Σ Δx log₁₀(1 + (t − tᵢ)/t₀), over the moves Δx at tᵢ of the run",
            source="Jung and Gweon, Review of Scientific Instruments 71 (2000) 1896–1900",
            parameters=(
                Parameter("rate", "γ, share of a move per decade of time", "", 0.0, 0.1, 0.015),
                Parameter("onset", "t₀, start of the logarithm", "s", 1e-3, 10.0, 0.1),
            ),
            acts=Drive(step=relaxations, states=_STATES),
            prepare=_terms,
            traits=frozenset({Trait.LINEAR}),
        ),
    ),
)
