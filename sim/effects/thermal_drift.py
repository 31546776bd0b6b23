"""Drift of the frame as it warms up: it grows without motion, and settles.

With two bodies that warm up at different rates, such as a tool and the frame that holds it, the
drift may grow, turn and come back.
"""

from collections.abc import Iterator

import numpy as np

from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    Formulation,
    PositionFunction,
    Values,
)
from rotemina.sim.effects.identification import FitView, IdentificationHints
from rotemina.sim.effects.kinship import EffectFamily, EffectRelations
from rotemina.sim.effects.starts import start_from_sizes


def add_warm_up_drift(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = x + A (1 − exp(−t/τ))``. p: A, τ."""
    return x - p[0] * np.expm1(-t / p[1])


def add_drift_of_two_bodies(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = x + A₁ (1 − exp(−t/τ₁)) + A₂ (1 − exp(−t/τ₂))``. p: A₁, τ₁, A₂, τ₂."""
    return x - p[0] * np.expm1(-t / p[1]) - p[2] * np.expm1(-t / p[3])


def _make_amplitude(name: str, meaning: str, typical: float) -> EffectParameter:
    return EffectParameter(name, meaning, "q", -0.1, 0.1, typical, per="span", linear=True)


_AMPLITUDE = _make_amplitude("amplitude", "A, final drift", 0.005)
_TIME_CONSTANT = EffectParameter("time_constant", "τ", "s", 0.1, 1e5, 60.0)

# Starts of the two time constants, as multiples of the longest record.
_START_RATIOS = ((0.02, 0.2), (0.1, 1.0))


def _start_from_durations(view: FitView) -> Iterator[Values]:
    """Start from several time constants; those of two bodies are a share of the records."""
    if "time_constant_2" not in view.values:
        yield from start_from_sizes(time_constant=(0.03, 0.2, 1.0))(view)
        return
    for fast, slow in _START_RATIOS:
        duration_s = view.extent.longest_s
        yield {"time_constant": fast * duration_s, "time_constant_2": slow * duration_s}


THERMAL_DRIFT = Effect(
    id="thermal_drift",
    title="Thermal drift",
    summary="Grows without motion and settles, regardless of the command.",
    stage=EffectStage.MECHANICS,
    kinds=EVERY_KIND,
    # On an axis that moves, creep after its moves has the same shape.
    identification=IdentificationHints(
        starts=_start_from_durations, shown_at_rest=frozenset({"two_bodies"})
    ),
    kinship=EffectRelations(family=EffectFamily.DRIFT),
    formulations=(
        Formulation(
            name="warm_up",
            equation="y = x + A (1 − exp(−t/τ)), t since the run began",
            source="Incropera et al., Fundamentals of Heat and Mass Transfer (2007), ch. 5",
            parameters=(_AMPLITUDE, _TIME_CONSTANT),
            acts=PositionFunction(step=add_warm_up_drift),
            traits=frozenset({EffectTrait.LOCKED_TO_TIME}),
        ),
        Formulation(
            name="two_bodies",
            equation="y = x + A (1 − exp(−t/τ)) + A₂ (1 − exp(−t/τ₂)), t since the run began",
            source="Ramesh, Mannan and Poo, Int. J. Mach. Tools Manuf. 40 (2000) 1257–1284",
            parameters=(
                _AMPLITUDE,
                _TIME_CONSTANT,
                _make_amplitude("amplitude_2", "A₂, that of the slower body", -0.0025),
                EffectParameter("time_constant_2", "τ₂", "s", 0.1, 1e5, 600.0),
            ),
            acts=PositionFunction(step=add_drift_of_two_bodies),
            traits=frozenset({EffectTrait.LOCKED_TO_TIME}),
        ),
    ),
)
