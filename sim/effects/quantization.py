"""Coarse converter or step size: the input moves in steps."""

from functools import partial

import numpy as np

from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    Formulation,
    InputFunction,
)
from rotemina.sim.effects.identification import IdentificationHints
from rotemina.sim.effects.starts import start_from_grid


def round_to_grid(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = L + Δ round((x − L)/Δ)``, or ``y = x`` if Δ is 0. p: Δ, L."""
    if p[0] <= 0.0:
        return x
    return p[1] + p[0] * np.rint((x - p[1]) / p[0])


QUANTIZATION = Effect(
    id="quantization",
    title="Quantization",
    summary="The response comes in steps, which the mechanics filter.",
    stage=EffectStage.ELECTRONICS,
    kinds=EVERY_KIND,
    identification=IdentificationHints(
        starts=partial(start_from_grid, at_input=True), stepped=True
    ),
    formulations=(
        Formulation(
            name="uniform",
            equation="y = L + σ Δ + Δ round((x − L)/Δ − σ), L the low end of the input's range",
            source="Widrow and Kollár, Quantization Noise (2008), ch. 1",
            parameters=(
                EffectParameter("step", "Δ", "u", 0.0, 0.05, 1.0 / 4096.0, per="input_span"),
                EffectParameter("shift", "σ, shift of the grid, in steps", "", -0.5, 0.5, 0.0),
            ),
            acts=InputFunction(step=round_to_grid),
            prepare=lambda values, facts: (
                values["step"],
                facts.input_low + values["shift"] * values["step"],
            ),
            traits=frozenset({EffectTrait.MEMORYLESS, EffectTrait.RATE_INDEPENDENT}),
        ),
    ),
)
