"""Sensor that reads in coarser steps than declared."""

from functools import partial

import numpy as np

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
from rotemina.sim.effects.starts import start_from_grid


def round_to_grid(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = Δ (round(x/Δ − z) + z)``, or ``y = x`` if Δ is 0. p: Δ, z."""
    if p[0] <= 0.0:
        return x
    return p[0] * (np.rint(x / p[0] - p[1]) + p[1])


SENSOR_QUANTIZATION = Effect(
    id="sensor_quantization",
    title="Sensor quantization",
    summary="Steps of the reading, sharp at any speed: no mechanics filters them.",
    stage=EffectStage.SENSOR,
    kinds=EVERY_KIND,
    identification=IdentificationHints(
        starts=partial(start_from_grid, at_input=False),
        stepped=True,
        shows_as=EffectSignature.STEPS,
    ),
    formulations=(
        Formulation(
            name="uniform",
            equation="y = Δ (round(q/Δ − z) + z)",
            source="Widrow and Kollár, Quantization Noise (2008), ch. 1",
            parameters=(
                EffectParameter("step", "Δ", "q", 0.0, 1000.0, 20.0, per="noise"),
                EffectParameter("shift", "z, position of zero within a step", "", -0.5, 0.5, 0.0),
            ),
            acts=ReadingFunction(step=round_to_grid, digital=True),
            traits=frozenset(
                {EffectTrait.MEMORYLESS, EffectTrait.RATE_INDEPENDENT, EffectTrait.READING_ONLY}
            ),
        ),
    ),
)
