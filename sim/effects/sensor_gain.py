"""A sensor whose sensitivity differs from its data sheet."""

from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    Formulation,
    Parameter,
    Reading,
    Stage,
    Trait,
)
from rotemina.sim.effects.kinship import Family, Kinship


def scaled(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = (1 + e) x``, about the sensor's own zero. p: e."""
    return x + p[0] * x


SENSOR_GAIN = Effect(
    id="sensor_gain",
    title="Sensor gain error",
    summary="The reading is off in proportion to the position; the motion is not.",
    stage=Stage.SENSOR,
    kinds=EVERY_KIND,
    kinship=Kinship(family=Family.GAIN, prior=0.5),
    formulations=(
        Formulation(
            name="proportional",
            equation="y = (1 + e) q",
            source="Fleming, Sensors and Actuators A 190 (2013) 106–126",
            parameters=(Parameter("error", "e, relative", "", -0.5, 0.5, 0.02),),
            acts=Reading(step=scaled),
            traits=frozenset(
                {Trait.LINEAR, Trait.MEMORYLESS, Trait.RATE_INDEPENDENT, Trait.READING_ONLY}
            ),
        ),
    ),
)
