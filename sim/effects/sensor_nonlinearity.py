"""Sensor with a bowed characteristic: right at both ends of the range, wrong in between."""

from math import sqrt

from rotemina.sim.effects import bends
from rotemina.sim.effects.facts import AxisProperties
from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    Formulation,
    ReadingFunction,
    Values,
)
from rotemina.sim.effects.identification import IdentificationHints
from rotemina.sim.effects.kinship import EffectFamily, EffectRelations
from rotemina.sim.effects.starts import start_along_travel

# Maximum of ξ − ξ³, at ξ = 1/√3.
_CUBIC_PEAK = 2.0 / (3.0 * sqrt(3.0))


def add_bow_and_cubic(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = x + (1 − ξ²)(b + c′ ξ)``, ξ = −1 and 1 at the ends. p: middle, 2/span, b, c′."""
    xi = (x - p[0]) * p[1]
    return x + (1.0 - xi * xi) * (p[2] + p[3] * xi)


def _compute_numbers(values: Values, facts: AxisProperties) -> tuple[float, ...]:
    middle = 0.5 * (facts.low + facts.high)
    return middle, 2.0 / facts.span, values["bow"], values["cubic"] / _CUBIC_PEAK


_TRAITS = frozenset(
    {EffectTrait.MEMORYLESS, EffectTrait.RATE_INDEPENDENT, EffectTrait.READING_ONLY}
)

SENSOR_NONLINEARITY = Effect(
    id="sensor_nonlinearity",
    title="Sensor nonlinearity",
    summary="The reading follows a bent curve without memory; the motion does not.",
    stage=EffectStage.SENSOR,
    kinds=EVERY_KIND,
    identification=IdentificationHints(starts=start_along_travel),
    kinship=EffectRelations(
        family=EffectFamily.CURVE, prior=0.5, brings_along={EffectFamily.GAIN: 1.0}
    ),
    formulations=(
        Formulation(
            name="bow_and_cubic",
            equation="y = q + (1 − ξ²)(b + c ξ·3√3/2), ξ = −1…1 over the range",
            source="Fleming, Sensors and Actuators A 190 (2013) 106–126",
            parameters=(
                EffectParameter(
                    "bow", "b, error in mid-range", "q", -0.1, 0.1, 0.004, per="span", linear=True
                ),
                EffectParameter(
                    "cubic",
                    "c, maximum of the odd part",
                    "q",
                    -0.1,
                    0.1,
                    0.001,
                    per="span",
                    linear=True,
                ),
            ),
            acts=ReadingFunction(step=add_bow_and_cubic),
            prepare=_compute_numbers,
            traits=_TRAITS,
        ),
        Formulation(
            name="series",
            equation=bends.EQUATION,
            source=bends.SOURCE,
            parameters=bends.make_parameters(),
            acts=ReadingFunction(step=bends.add_sine_series),
            prepare=lambda values, facts: bends.compute_numbers(values, facts.low, facts.span),
            traits=_TRAITS,
        ),
    ),
)
