"""Flexure that stiffens as it bends.

The static curve is bowed, and the resonance depends on the position.
"""

from collections.abc import Iterator

from rotemina.sim.effects.facts import AxisProperties
from rotemina.sim.effects.formulation import (
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    ForceFunction,
    Formulation,
    Values,
)
from rotemina.sim.effects.identification import FitView, IdentificationHints
from rotemina.sim.effects.kinship import EffectFamily, EffectRelations

# Inner step in periods of the axis; the error grows with its square.
_INNER_STEP_PERIODS = 1.0 / 30.0


def compute_cubic_force(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Return ``f = −K (x − x₀)³`` at mid-step, where f itself has moved the axis by ``a f/2``.

    This is the midpoint rule, solved by Newton's method. p: K, x₀.
    """
    deflection = x - p[1]
    force = 0.0
    for _ in range(2):
        mid_deflection = deflection + 0.5 * a * force
        force -= (force + p[0] * mid_deflection**3) / (1.0 + 1.5 * a * p[0] * mid_deflection**2)
    return force


def compute_cubic_quintic_force(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Return ``f = −(K₃ d³ + K₅ d⁵)``, ``d = x − x₀``, in the same way. p: K₃, x₀, K₅."""
    deflection = x - p[1]
    force = 0.0
    for _ in range(3):
        mid_deflection = deflection + 0.5 * a * force
        square = mid_deflection * mid_deflection
        residual = force + (p[0] + p[2] * square) * square * mid_deflection
        slope = 1.0 + 0.5 * a * (3.0 * p[0] + 5.0 * p[2] * square) * square
        force -= residual / slope
    return force


def _compute_cubic_numbers(values: Values, facts: AxisProperties) -> tuple[float, ...]:
    """Return p of :func:`compute_cubic_force`.

    ``hardening`` is the force at half the range from x₀, over that of the linear stiffness. Its
    lower bound is slightly below zero, so that a fit may pass through zero. With a more negative
    value, a step over the whole range could throw the axis out of its potential well.
    """
    half_range = 0.5 * facts.span
    middle = 0.5 * (facts.low + facts.high)
    return (values["hardening"] * facts.stiffness / half_range**2, middle + values["centre"])


def _compute_quintic_numbers(values: Values, facts: AxisProperties) -> tuple[float, ...]:
    half_range = 0.5 * facts.span
    return (
        *_compute_cubic_numbers(values, facts),
        values["quintic"] * facts.stiffness / half_range**4,
    )


def _compute_inner_step(_values: Values, facts: AxisProperties) -> float:
    return _INNER_STEP_PERIODS / facts.frequency_hz


_HARDENING = EffectParameter(
    "hardening", "ε, share of added force at distance L from q₀", "", -0.01, 1.0, 0.05, linear=True
)
_CENTRE = EffectParameter(
    "centre", "position of the straight part, from mid-range", "q", -0.5, 0.5, 0.0, per="span"
)
_TRAITS = frozenset({EffectTrait.MEMORYLESS, EffectTrait.RATE_INDEPENDENT, EffectTrait.DISSIPATIVE})

# Start values of the centre, relative to the range and counted from its middle.
_START_CENTRE_RATIOS = (-0.45, -0.2, 0.0, 0.2, 0.45)
# Start values of the hardening, as multiples of its preset.
_HARDENING_FACTORS = (1.0, 4.0)


def _start_from_centres(view: FitView) -> Iterator[Values]:
    # A simpler formulation was fitted: start from its parameters.
    if view.starts_from_other_fit:
        yield {}
        return
    for ratio in _START_CENTRE_RATIOS:
        for factor in _HARDENING_FACTORS:
            yield {
                "centre": ratio * view.facts.span,
                "hardening": factor * view.values["hardening"],
            }


STIFFNESS_NONLINEARITY = Effect(
    id="stiffness_nonlinearity",
    title="Stiffness nonlinearity",
    summary="A curved static characteristic, and a resonance that shifts with position.",
    stage=EffectStage.MECHANICS,
    kinds=frozenset({"piezo"}),
    identification=IdentificationHints(starts=_start_from_centres, from_other=dict),
    kinship=EffectRelations(brings_along={EffectFamily.GAIN: 1.0}),
    formulations=(
        Formulation(
            name="cubic",
            equation="f = −ε k (q − q₀)³ / L², L half the range, k the linear stiffness",
            source="Kovacic and Brennan, The Duffing Equation (2011), ch. 2",
            parameters=(_HARDENING, _CENTRE),
            acts=ForceFunction(step=compute_cubic_force),
            prepare=_compute_cubic_numbers,
            inner_step_s=_compute_inner_step,
            traits=_TRAITS,
        ),
        Formulation(
            name="cubic_quintic",
            equation="f = −k (ε (q − q₀)³ / L² + μ (q − q₀)⁵ / L⁴), L half the range",
            source="Kovacic and Brennan, The Duffing Equation (2011), ch. 2",
            parameters=(
                _HARDENING,
                _CENTRE,
                EffectParameter("quintic", "μ, the same for the fifth power", "", 0.0, 1.0, 0.02),
            ),
            acts=ForceFunction(step=compute_cubic_quintic_force),
            prepare=_compute_quintic_numbers,
            inner_step_s=_compute_inner_step,
            traits=_TRAITS,
        ),
    ),
)
