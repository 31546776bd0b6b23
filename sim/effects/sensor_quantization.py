"""A sensor that reads in coarser steps than declared."""

from functools import partial

import numpy as np

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
from rotemina.sim.effects.starts import teeth


def rounded(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = Δ (round(x/Δ − z) + z)``. p: Δ, z."""
    if p[0] <= 0.0:
        return x
    return p[0] * (np.rint(x / p[0] - p[1]) + p[1])


SENSOR_QUANTIZATION = Effect(
    id="sensor_quantization",
    title="Sensor quantization",
    summary="Steps of the reading, sharp at any speed: no mechanics filters them.",
    stage=Stage.SENSOR,
    kinds=EVERY_KIND,
    identification=Identification(
        starts=partial(teeth, at_input=False), stepped=True, shows_as=Sign.STEPS
    ),
    formulations=(
        Formulation(
            name="uniform",
            equation="y = Δ (round(q/Δ − z) + z)",
            source="Widrow and Kollár, Quantization Noise (2008), ch. 1",
            parameters=(
                Parameter("step", "Δ", "q", 0.0, 1000.0, 20.0, per="noise"),
                Parameter("shift", "z, position of zero within a step", "", -0.5, 0.5, 0.0),
            ),
            acts=Reading(step=rounded, digital=True),
            traits=frozenset({Trait.MEMORYLESS, Trait.RATE_INDEPENDENT, Trait.READING_ONLY}),
        ),
    ),
)
