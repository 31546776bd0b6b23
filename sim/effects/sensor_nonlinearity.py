"""A sensor with a bowed characteristic: right at both ends of the range, wrong in between."""

from math import sqrt

from rotemina.sim.effects import bends
from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    Formulation,
    Parameter,
    Reading,
    Stage,
    Trait,
    Values,
)
from rotemina.sim.effects.identification import Identification
from rotemina.sim.effects.kinship import Family, Kinship
from rotemina.sim.effects.starts import along_the_way

_CUBIC_PEAK = 2.0 / (3.0 * sqrt(3.0))  # of ξ − ξ³, at ξ = 1/√3


def bowed(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = x + (1 − ξ²)(b + c′ ξ)``, ξ = −1 and 1 at the ends. p: middle, 2/span, b, c′."""
    place = (x - p[0]) * p[1]
    return x + (1.0 - place * place) * (p[2] + p[3] * place)


def _over_the_range(values: Values, facts: Facts) -> tuple[float, ...]:
    middle = 0.5 * (facts.low + facts.high)
    return middle, 2.0 / facts.span, values["bow"], values["cubic"] / _CUBIC_PEAK


_TRAITS = frozenset({Trait.MEMORYLESS, Trait.RATE_INDEPENDENT, Trait.READING_ONLY})

SENSOR_NONLINEARITY = Effect(
    id="sensor_nonlinearity",
    title="Sensor nonlinearity",
    summary="The reading follows a bent curve without memory; the motion does not.",
    stage=Stage.SENSOR,
    kinds=EVERY_KIND,
    identification=Identification(starts=along_the_way),
    kinship=Kinship(family=Family.CURVE, prior=0.5, brings_along={Family.GAIN: 1.0}),
    formulations=(
        Formulation(
            name="bow_and_cubic",
            equation="y = q + (1 − ξ²)(b + c ξ·3√3/2), ξ = −1…1 over the range",
            source="Fleming, Sensors and Actuators A 190 (2013) 106–126",
            parameters=(
                Parameter(
                    "bow", "b, error in mid-range", "q", -0.1, 0.1, 0.004, per="span", linear=True
                ),
                Parameter(
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
            acts=Reading(step=bowed),
            prepare=_over_the_range,
            traits=_TRAITS,
        ),
        Formulation(
            name="series",
            equation=bends.EQUATION,
            source=bends.SOURCE,
            parameters=bends.parameters(),
            acts=Reading(step=bends.bent),
            prepare=lambda values, facts: bends.numbers(values, facts.low, facts.span),
            traits=_TRAITS,
        ),
    ),
)
