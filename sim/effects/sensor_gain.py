"""Sensor whose sensitivity differs from its data sheet."""

from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    Formulation,
    ReadingFunction,
)
from rotemina.sim.effects.kinship import EffectFamily, EffectRelations


def scale_reading(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = (1 + e) x``, about the sensor's own zero. p: e."""
    return x + p[0] * x


SENSOR_GAIN = Effect(
    id="sensor_gain",
    title="Sensor gain error",
    summary="The reading is off in proportion to the position; the motion is not.",
    stage=EffectStage.SENSOR,
    kinds=EVERY_KIND,
    kinship=EffectRelations(family=EffectFamily.GAIN, prior=0.5),
    formulations=(
        Formulation(
            name="proportional",
            equation="y = (1 + e) q",
            source="Fleming, Sensors and Actuators A 190 (2013) 106–126",
            parameters=(EffectParameter("error", "e, relative", "", -0.5, 0.5, 0.02),),
            acts=ReadingFunction(step=scale_reading),
            traits=frozenset(
                {
                    EffectTrait.LINEAR,
                    EffectTrait.MEMORYLESS,
                    EffectTrait.RATE_INDEPENDENT,
                    EffectTrait.READING_ONLY,
                }
            ),
        ),
    ),
)
