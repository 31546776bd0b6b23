"""Drift of the frame as it warms up: grows without motion, and settles."""

import numpy as np

from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    Formulation,
    Motion,
    Parameter,
    Stage,
    Trait,
)
from rotemina.sim.effects.identification import Identification
from rotemina.sim.effects.kinship import Family, Kinship
from rotemina.sim.effects.starts import sizes


def warm_up(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = x + A (1 − exp(−t/τ))``. p: A, τ."""
    return x - p[0] * np.expm1(-t / p[1])


THERMAL_DRIFT = Effect(
    id="thermal_drift",
    title="Thermal drift",
    summary="Grows without motion and settles, regardless of the command.",
    stage=Stage.MECHANICS,
    kinds=EVERY_KIND,
    identification=Identification(starts=sizes(time_constant=(0.03, 0.2, 1.0))),
    kinship=Kinship(family=Family.DRIFT),
    formulations=(
        Formulation(
            name="warm_up",
            equation="y = x + A (1 − exp(−t/τ)), t since the run began",
            source="Incropera et al., Fundamentals of Heat and Mass Transfer (2007), ch. 5",
            parameters=(
                Parameter(
                    "amplitude",
                    "A, final drift",
                    "q",
                    -0.1,
                    0.1,
                    0.005,
                    per="span",
                    linear=True,
                ),
                Parameter("time_constant", "τ", "s", 0.1, 1e5, 60.0),
            ),
            acts=Motion(step=warm_up),
            traits=frozenset({Trait.LOCKED_TO_TIME}),
        ),
    ),
)
