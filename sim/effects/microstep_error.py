"""Unequal microsteps: an error that repeats every four full steps of the command."""

from rotemina.sim.effects.formulation import (
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    Formulation,
    InputFunction,
)
from rotemina.sim.effects.harmonics import add_two_harmonics, compute_numbers, make_amplitude_shift
from rotemina.sim.effects.identification import IdentificationHints
from rotemina.sim.effects.kinship import EffectFamily, EffectRelations
from rotemina.sim.effects.starts import start_from_periods


def _make_amplitude(name: str, meaning: str, typical: float) -> EffectParameter:
    return EffectParameter(name, meaning, "q", -0.6, 0.6, typical, per="full_step", linear=True)


MICROSTEP_ERROR = Effect(
    id="microstep_error",
    title="Microstep error",
    summary="Periodic in the commanded position, every four full steps; the mechanics filter it.",
    stage=EffectStage.ACTUATOR,
    kinds=frozenset({"stepper"}),
    identification=IdentificationHints(
        starts=start_from_periods(1.0),
        moved=make_amplitude_shift(("sine", "cosine"), ("sine_2", "cosine_2")),
    ),
    kinship=EffectRelations(family=EffectFamily.PERIOD),
    formulations=(
        Formulation(
            name="harmonics",
            equation="y = x + s₁ sin α + c₁ cos α + s₂ sin 2α + c₂ cos 2α, α = 2π (x − xₘ)/P",
            source="Acarnley, Stepping Motors, 4th ed. (2002), ch. 5: offset and gain errors of "
            "the phase currents give the first and second harmonic of the electrical period",
            parameters=(
                EffectParameter(
                    "period", "P, four full steps", "q", 3.8, 4.2, 4.0, per="full_step"
                ),
                _make_amplitude("sine", "s₁, counted from mid-range xₘ", 0.05),
                _make_amplitude("cosine", "c₁", 0.0),
                _make_amplitude("sine_2", "s₂, twice a period", 0.02),
                _make_amplitude("cosine_2", "c₂, twice a period", 0.0),
            ),
            acts=InputFunction(step=add_two_harmonics),
            prepare=compute_numbers,
            traits=frozenset({EffectTrait.MEMORYLESS, EffectTrait.RATE_INDEPENDENT}),
        ),
    ),
)
