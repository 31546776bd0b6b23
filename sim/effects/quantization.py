"""A coarse converter or step size: the input comes in steps."""

from functools import partial

import numpy as np

from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Drive,
    Effect,
    Formulation,
    Parameter,
    Stage,
    Trait,
)
from rotemina.sim.effects.identification import Identification
from rotemina.sim.effects.starts import teeth


def rounded(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = L + Δ round((x − L)/Δ)``, x itself where Δ is 0. p: Δ, L."""
    if p[0] <= 0.0:
        return x
    return p[1] + p[0] * np.rint((x - p[1]) / p[0])


QUANTIZATION = Effect(
    id="quantization",
    title="Quantization",
    summary="The response comes in steps, which the mechanics filter.",
    stage=Stage.ELECTRONICS,
    kinds=EVERY_KIND,
    identification=Identification(starts=partial(teeth, at_input=True), stepped=True),
    formulations=(
        Formulation(
            name="uniform",
            equation="y = L + σ Δ + Δ round((x − L)/Δ − σ), L the low end of the input's range",
            source="Widrow and Kollár, Quantization Noise (2008), ch. 1",
            parameters=(
                Parameter("step", "Δ", "u", 0.0, 0.05, 1.0 / 4096.0, per="input_span"),
                Parameter("shift", "σ, shift of the grid, in steps", "", -0.5, 0.5, 0.0),
            ),
            acts=Drive(step=rounded),
            prepare=lambda values, facts: (
                values["step"],
                facts.input_low + values["shift"] * values["step"],
            ),
            traits=frozenset({Trait.MEMORYLESS, Trait.RATE_INDEPENDENT}),
        ),
    ),
)
