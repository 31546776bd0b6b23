"""Drift of the frame as it warms up: it grows without motion, and settles."""

import numpy as np

from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    Formulation,
    PositionFunction,
)
from rotemina.sim.effects.identification import IdentificationHints
from rotemina.sim.effects.kinship import EffectFamily, EffectRelations
from rotemina.sim.effects.starts import start_from_sizes


def add_warm_up_drift(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = x + A (1 − exp(−t/τ))``. p: A, τ."""
    return x - p[0] * np.expm1(-t / p[1])


THERMAL_DRIFT = Effect(
    id="thermal_drift",
    title="Thermal drift",
    summary="Grows without motion and settles, regardless of the command.",
    stage=EffectStage.MECHANICS,
    kinds=EVERY_KIND,
    identification=IdentificationHints(starts=start_from_sizes(time_constant=(0.03, 0.2, 1.0))),
    kinship=EffectRelations(family=EffectFamily.DRIFT),
    formulations=(
        Formulation(
            name="warm_up",
            equation="y = x + A (1 − exp(−t/τ)), t since the run began",
            source="Incropera et al., Fundamentals of Heat and Mass Transfer (2007), ch. 5",
            parameters=(
                EffectParameter(
                    "amplitude",
                    "A, final drift",
                    "q",
                    -0.1,
                    0.1,
                    0.005,
                    per="span",
                    linear=True,
                ),
                EffectParameter("time_constant", "τ", "s", 0.1, 1e5, 60.0),
            ),
            acts=PositionFunction(step=add_warm_up_drift),
            traits=frozenset({EffectTrait.LOCKED_TO_TIME}),
        ),
    ),
)
