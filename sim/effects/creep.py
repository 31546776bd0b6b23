"""Creep of a piezo: after a move, motion continues by the same amount in each decade of time."""

import numpy as np

from rotemina.sim.effects.facts import AxisProperties
from rotemina.sim.effects.formulation import (
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    Formulation,
    InputFunction,
    Values,
)
from rotemina.sim.effects.identification import IdentificationHints
from rotemina.sim.effects.kinship import EffectFamily, EffectRelations
from rotemina.sim.effects.starts import start_from_sizes

TERM_COUNT = 12
# Logarithm of the ratio of neighbouring rates.
_LOG_RATE_SPACING = 1.45
# An input held longer than any run lasts stands for the approach to the start of the run.
_MIN_INITIAL_HOLD_S = 1e8
# Step lengths that differ by less than this, relatively, differ only by rounding.
_STEP_TOLERANCE_RATIO = 1e-9

# Indices in the memory ``s``, after the states of the terms.
_INITIAL_INPUT_INDEX, _STEP_INDEX, _FASTEST_TIME_INDEX = TERM_COUNT, TERM_COUNT + 1, TERM_COUNT + 2
_MOVED_FRACTION_INDEX, _MEAN_FRACTION_INDEX = TERM_COUNT + 3, 2 * TERM_COUNT + 3
_STATE_COUNT = 3 * TERM_COUNT + 3


def apply_relaxations(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = x + Σ wᵢ (zᵢ − x₀)``, ``τᵢ żᵢ = x − zᵢ``, from rest at x₀.

    p: τᵢ, then wᵢ. s: zᵢ, x₀, then h and τ₀ of the last call, and two values of each term that
    depend only on them: the fraction of its distance to x that the term moves in a step, and the
    mean of this fraction over the step.
    """
    if h > _MIN_INITIAL_HOLD_S:
        s[_INITIAL_INPUT_INDEX] = x
        for i in range(TERM_COUNT):
            s[i] = x
        return x
    y = x
    if h == 0.0:
        for i in range(TERM_COUNT):
            y += p[TERM_COUNT + i] * (s[i] - s[_INITIAL_INPUT_INDEX])
        return y
    if abs(h - s[_STEP_INDEX]) > _STEP_TOLERANCE_RATIO * h or p[0] != s[_FASTEST_TIME_INDEX]:
        s[_STEP_INDEX], s[_FASTEST_TIME_INDEX] = h, p[0]
        for i in range(TERM_COUNT):
            s[_MOVED_FRACTION_INDEX + i] = -np.expm1(-h / p[i])
            s[_MEAN_FRACTION_INDEX + i] = 1.0 - s[_MOVED_FRACTION_INDEX + i] * p[i] / h
    for i in range(TERM_COUNT):
        distance = x - s[i]
        y += p[TERM_COUNT + i] * (
            s[i] + s[_MEAN_FRACTION_INDEX + i] * distance - s[_INITIAL_INPUT_INDEX]
        )
        s[i] += s[_MOVED_FRACTION_INDEX + i] * distance
    return y


def _compute_terms(values: Values, _facts: AxisProperties) -> tuple[float, ...]:
    """Return p, with the terms evenly spaced in the logarithm of their rate.

    ``ln(1 + t/t₀) = ∫ (1 − exp(−σt/t₀)) exp(−σ)/σ dσ`` by the trapezoidal rule in ln σ, which
    converges exponentially. The slowest term also replaces all slower ones, which would move
    linearly. The error is within 0.2 % of the creep per decade up to 2·10⁵ t₀, and within 2 % up
    to 10⁶ t₀.
    """
    rates = np.exp(_LOG_RATE_SPACING * (1.0 - np.arange(TERM_COUNT)))
    weights = _LOG_RATE_SPACING * np.exp(-rates)
    weights[-1] /= -np.expm1(-_LOG_RATE_SPACING)
    weights *= values["rate"] / np.log(10.0)
    return (*(values["onset"] / rates), *weights)


CREEP = Effect(
    id="creep",
    title="Creep",
    summary="Motion continues after a move, proportional to it, with the logarithm of time.",
    stage=EffectStage.ACTUATOR,
    kinds=frozenset({"piezo"}),
    identification=IdentificationHints(starts=start_from_sizes(onset=(0.3, 3.0))),
    kinship=EffectRelations(family=EffectFamily.CREEP, brings_along={EffectFamily.DRIFT: 0.1}),
    formulations=(
        Formulation(
            name="logarithmic",
            equation="y = x + γ Σ Δx log₁₀(1 + (t − tᵢ)/t₀), over the moves Δx at tᵢ of the run",
            source="Jung and Gweon, Review of Scientific Instruments 71 (2000) 1896–1900",
            parameters=(
                EffectParameter(
                    "rate", "γ, share of a move per decade of time", "", 0.0, 0.1, 0.015
                ),
                EffectParameter("onset", "t₀, start of the logarithm", "s", 1e-3, 10.0, 0.1),
            ),
            acts=InputFunction(step=apply_relaxations, states=_STATE_COUNT),
            prepare=_compute_terms,
            traits=frozenset({EffectTrait.LINEAR}),
        ),
    ),
)
