"""A sensor that is noisier than declared."""

from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    Formulation,
    Parameter,
    Reading,
    Stage,
    Trait,
)
from rotemina.sim.effects.identification import Identification, Sign


def noisy(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = x + σ a``. p: σ."""
    return x + p[0] * a


SENSOR_NOISE = Effect(
    id="sensor_noise",
    title="Sensor noise",
    summary="White noise of the reading above the declared level, without memory.",
    stage=Stage.SENSOR,
    kinds=EVERY_KIND,
    identification=Identification(shows_as=Sign.NOISE),
    formulations=(
        Formulation(
            name="white",
            equation="y = q + σ n, n independent and standard normal at each sample",
            source="Fleming, Sensors and Actuators A 190 (2013) 106–126",
            parameters=(
                Parameter(
                    "rms",
                    "σ, in addition to the declared noise",
                    "q",
                    0.0,
                    1000.0,
                    3.0,
                    per="noise",
                ),
            ),
            acts=Reading(step=noisy, random=True),
            traits=frozenset({Trait.RANDOM, Trait.READING_ONLY, Trait.LOCKED_TO_TIME}),
        ),
    ),
)
