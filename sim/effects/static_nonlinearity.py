"""A curved characteristic without memory.

All formulations keep the ends of the range, or of the curved section, in place, which separates
them from a gain error and an offset.
"""

import numpy as np

from rotemina.sim.effects import bends
from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import (
    EVERY_KIND,
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
from rotemina.sim.effects.starts import along_the_way

_CUBIC_PEAK = 2.0 / (3.0 * np.sqrt(3.0))  # of z − z³ within −1…1


def polynomial(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = x + b (1 − z²) + c (z − z³)``. p: b, c, middle, 1/half the length; z from these."""
    z = (x - p[2]) * p[3]
    return x + (1.0 - z * z) * (p[0] + p[1] * z)


def exponential(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = L + S (exp(κz) − 1)/(exp κ − 1)``, z = (x − L)/S. p: κ, L, S."""
    if p[0] == 0.0:
        return x
    return p[1] + p[2] * np.expm1(p[0] * (x - p[1]) / p[2]) / np.expm1(p[0])


def _ends(facts: Facts) -> tuple[float, float]:
    """Return the ends of an actuator's input: a position, or V for a force."""
    if facts.kind == "force":
        return facts.input_low, facts.input_high
    return facts.low, facts.high


def _polynomial(values: Values, facts: Facts) -> tuple[float, ...]:
    low, high = _ends(facts)
    bow, cubic = (high - low) * values["bow"], (high - low) * values["s_shape"]
    return (bow, cubic / _CUBIC_PEAK, 0.5 * (low + high), 2.0 / (high - low))


def _exponential(values: Values, facts: Facts) -> tuple[float, ...]:
    low, high = _ends(facts)
    return (values["curvature"], low, high - low)


def _series(values: Values, facts: Facts) -> tuple[float, ...]:
    low, high = _ends(facts)
    return bends.numbers(values, low, high - low)


_TRAITS = frozenset({Trait.MEMORYLESS, Trait.RATE_INDEPENDENT})

STATIC_NONLINEARITY = Effect(
    id="static_nonlinearity",
    title="Static nonlinearity",
    summary="A curve of the command, without memory, filtered by the mechanics.",
    stage=Stage.ACTUATOR,
    kinds=EVERY_KIND,
    identification=Identification(starts=along_the_way),
    kinship=Kinship(family=Family.CURVE, brings_along={Family.GAIN: 1.0}),
    formulations=(
        Formulation(
            name="polynomial",
            equation="y = x + b (1 − z²) + c (z − z³)/0.385, z = −1…1 along the range",
            source="Giri and Bai (eds.), Block-oriented Nonlinear System Identification (2010): "
            "polynomial Hammerstein systems",
            parameters=(
                Parameter(
                    "bow",
                    "b at mid-range, as a share of the range",
                    "",
                    -0.2,
                    0.2,
                    0.02,
                    linear=True,
                ),
                Parameter(
                    "s_shape",
                    "peak of c, as a share of the range",
                    "",
                    -0.05,
                    0.05,
                    0.0,
                    linear=True,
                ),
            ),
            acts=Drive(step=polynomial),
            prepare=_polynomial,
            traits=_TRAITS,
        ),
        Formulation(
            name="exponential",
            equation="y = L + S (exp(κz) − 1)/(exp κ − 1), z = (x − L)/S",
            source="Pintelon and Schoukens, System Identification, 2nd ed. (2012), ch. 3: "
            "static nonlinearities",
            parameters=(
                Parameter("curvature", "κ, logarithm of the slopes' ratio", "", -3.0, 3.0, -0.2),
            ),
            acts=Drive(step=exponential),
            prepare=_exponential,
            traits=_TRAITS,
        ),
        Formulation(
            name="series",
            equation=bends.EQUATION,
            source=bends.SOURCE,
            parameters=bends.parameters(),
            acts=Drive(step=bends.bent),
            prepare=_series,
            traits=_TRAITS,
        ),
    ),
)
