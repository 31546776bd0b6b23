"""Microsteps of unequal length: an error that repeats every four full steps of the command."""

from rotemina.sim.effects.formulation import (
    Drive,
    Effect,
    Formulation,
    Parameter,
    Stage,
    Trait,
)
from rotemina.sim.effects.harmonics import from_mid_range, moved, two_harmonics
from rotemina.sim.effects.identification import Identification
from rotemina.sim.effects.kinship import Family, Kinship
from rotemina.sim.effects.starts import periods


def _amplitude(name: str, meaning: str, typical: float) -> Parameter:
    return Parameter(name, meaning, "q", -0.6, 0.6, typical, per="full_step", linear=True)


MICROSTEP_ERROR = Effect(
    id="microstep_error",
    title="Microstep error",
    summary="Periodic in the commanded position, every four full steps; the mechanics filter it.",
    stage=Stage.ACTUATOR,
    kinds=frozenset({"stepper"}),
    identification=Identification(
        starts=periods(1.0), moved=moved(("sine", "cosine"), ("sine_2", "cosine_2"))
    ),
    kinship=Kinship(family=Family.PERIOD),
    formulations=(
        Formulation(
            name="harmonics",
            equation="y = x + s₁ sin α + c₁ cos α + s₂ sin 2α + c₂ cos 2α, α = 2π (x − xₘ)/P",
            source="Acarnley, Stepping Motors, 4th ed. (2002), ch. 5: offset and gain errors of "
            "the phase currents give the first and second harmonic of the electrical period",
            parameters=(
                Parameter("period", "P, four full steps", "q", 3.8, 4.2, 4.0, per="full_step"),
                _amplitude("sine", "s₁, counted from mid-range xₘ", 0.05),
                _amplitude("cosine", "c₁", 0.0),
                _amplitude("sine_2", "s₂, twice a period", 0.02),
                _amplitude("cosine_2", "c₂, twice a period", 0.0),
            ),
            acts=Drive(step=two_harmonics),
            prepare=from_mid_range,
            traits=frozenset({Trait.MEMORYLESS, Trait.RATE_INDEPENDENT}),
        ),
    ),
)
