"""Sensor that is noisier than declared."""

from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    Formulation,
    ReadingFunction,
)
from rotemina.sim.effects.identification import EffectSignature, IdentificationHints


def add_white_noise(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = x + σ a``. p: σ."""
    return x + p[0] * a


SENSOR_NOISE = Effect(
    id="sensor_noise",
    title="Sensor noise",
    summary="White noise of the reading above the declared level, without memory.",
    stage=EffectStage.SENSOR,
    kinds=EVERY_KIND,
    identification=IdentificationHints(shows_as=EffectSignature.NOISE),
    formulations=(
        Formulation(
            name="white",
            equation="y = q + σ n, n independent and standard normal at each sample",
            source="Fleming, Sensors and Actuators A 190 (2013) 106–126",
            parameters=(
                EffectParameter(
                    "rms",
                    "σ, in addition to the declared noise",
                    "q",
                    0.0,
                    1000.0,
                    3.0,
                    per="noise",
                ),
            ),
            acts=ReadingFunction(step=add_white_noise, random=True),
            traits=frozenset(
                {EffectTrait.RANDOM, EffectTrait.READING_ONLY, EffectTrait.LOCKED_TO_TIME}
            ),
        ),
    ),
)
