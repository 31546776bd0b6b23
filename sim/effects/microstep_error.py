"""Microsteps of unequal length: an error that repeats every four full steps of the command."""

import numpy as np

from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import (
    Drive,
    Effect,
    Formulation,
    Parameter,
    Stage,
    Trait,
    Values,
)


def periodic(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Add two harmonics of the commanded position.

    p: 2π/period, middle of the range, then sine and cosine amplitude of each. Of the second
    harmonic, ``sin 2α = 2 sin α cos α`` and ``cos 2α = 1 − 2 sin² α``.
    """
    angle = p[0] * (x - p[1])
    sine, cosine = np.sin(angle), np.cos(angle)
    second = 2.0 * p[4] * sine * cosine + p[5] * (1.0 - 2.0 * sine * sine)
    return x + p[2] * sine + p[3] * cosine + second


def _numbers(values: Values, facts: Facts) -> tuple[float, ...]:
    """Count from the middle of the range: there a slightly wrong period does least harm."""
    return (
        2.0 * np.pi / values["period"],
        0.5 * (facts.low + facts.high),
        values["sine"],
        values["cosine"],
        values["sine_2"],
        values["cosine_2"],
    )


def _amplitude(name: str, meaning: str, typical: float) -> Parameter:
    return Parameter(name, meaning, "q", -0.3, 0.3, typical, per="full_step")


MICROSTEP_ERROR = Effect(
    id="microstep_error",
    title="Microstep error",
    summary="Periodic in the commanded position, every four full steps; the mechanics filter it.",
    stage=Stage.ACTUATOR,
    kinds=frozenset({"stepper"}),
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
            acts=Drive(step=periodic),
            prepare=_numbers,
            traits=frozenset({Trait.MEMORYLESS, Trait.RATE_INDEPENDENT}),
        ),
    ),
)
