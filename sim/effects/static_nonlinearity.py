"""Curved characteristic without memory.

All formulations keep the ends of the range, or of the curved section, in place, which separates
them from a gain error and an offset.
"""

import numpy as np

from rotemina.sim.effects import bends
from rotemina.sim.effects.facts import AxisProperties
from rotemina.sim.effects.formulation import (
    EVERY_KIND,
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
from rotemina.sim.effects.starts import start_along_travel

# Maximum of z − z³ within −1…1.
_CUBIC_PEAK = 2.0 / (3.0 * np.sqrt(3.0))


def apply_polynomial(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = x + b (1 − z²) + c (z − z³)``.

    p: b, c, then the middle and 1/half the length of the section over which z is −1…1.
    """
    z = (x - p[2]) * p[3]
    return x + (1.0 - z * z) * (p[0] + p[1] * z)


def apply_exponential(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = L + S (exp(κz) − 1)/(exp κ − 1)``, z = (x − L)/S. p: κ, L, S."""
    if p[0] == 0.0:
        return x
    return p[1] + p[2] * np.expm1(p[0] * (x - p[1]) / p[2]) / np.expm1(p[0])


def _find_input_range(facts: AxisProperties) -> tuple[float, float]:
    """Return the ends of the actuator's input: positions, or V for a force."""
    if facts.kind == "force":
        return facts.input_low, facts.input_high
    return facts.low, facts.high


def _compute_polynomial_numbers(values: Values, facts: AxisProperties) -> tuple[float, ...]:
    low, high = _find_input_range(facts)
    bow, cubic = (high - low) * values["bow"], (high - low) * values["s_shape"]
    return (bow, cubic / _CUBIC_PEAK, 0.5 * (low + high), 2.0 / (high - low))


def _compute_exponential_numbers(values: Values, facts: AxisProperties) -> tuple[float, ...]:
    low, high = _find_input_range(facts)
    return (values["curvature"], low, high - low)


def _compute_series_numbers(values: Values, facts: AxisProperties) -> tuple[float, ...]:
    low, high = _find_input_range(facts)
    return bends.compute_numbers(values, low, high - low)


_TRAITS = frozenset({EffectTrait.MEMORYLESS, EffectTrait.RATE_INDEPENDENT})

STATIC_NONLINEARITY = Effect(
    id="static_nonlinearity",
    title="Static nonlinearity",
    summary="A curve of the command, without memory, filtered by the mechanics.",
    stage=EffectStage.ACTUATOR,
    kinds=EVERY_KIND,
    identification=IdentificationHints(starts=start_along_travel),
    kinship=EffectRelations(family=EffectFamily.CURVE, brings_along={EffectFamily.GAIN: 1.0}),
    formulations=(
        Formulation(
            name="polynomial",
            equation="y = x + b (1 − z²) + c (z − z³)/0.385, z = −1…1 along the range",
            source="Giri and Bai (eds.), Block-oriented Nonlinear System Identification (2010): "
            "polynomial Hammerstein systems",
            parameters=(
                EffectParameter(
                    "bow",
                    "b at mid-range, as a share of the range",
                    "",
                    -0.2,
                    0.2,
                    0.02,
                    linear=True,
                ),
                EffectParameter(
                    "s_shape",
                    "peak of c, as a share of the range",
                    "",
                    -0.05,
                    0.05,
                    0.0,
                    linear=True,
                ),
            ),
            acts=InputFunction(step=apply_polynomial),
            prepare=_compute_polynomial_numbers,
            traits=_TRAITS,
        ),
        Formulation(
            name="exponential",
            equation="y = L + S (exp(κz) − 1)/(exp κ − 1), z = (x − L)/S",
            source="Pintelon and Schoukens, System Identification, 2nd ed. (2012), ch. 3: "
            "static nonlinearities",
            parameters=(
                EffectParameter(
                    "curvature", "κ, logarithm of the slopes' ratio", "", -3.0, 3.0, -0.2
                ),
            ),
            acts=InputFunction(step=apply_exponential),
            prepare=_compute_exponential_numbers,
            traits=_TRAITS,
        ),
        Formulation(
            name="series",
            equation=bends.EQUATION,
            source=bends.SOURCE,
            parameters=bends.make_parameters(),
            acts=InputFunction(step=bends.add_sine_series),
            prepare=_compute_series_numbers,
            traits=_TRAITS,
        ),
    ),
)
