"""Encoder that divides the period of its grating unevenly."""

import numpy as np

from rotemina.sim.effects.facts import AxisProperties
from rotemina.sim.effects.formulation import (
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    Formulation,
    ReadingFunction,
    Values,
)
from rotemina.sim.effects.harmonics import make_amplitude_shift
from rotemina.sim.effects.identification import IdentificationHints
from rotemina.sim.effects.kinship import EffectFamily, EffectRelations
from rotemina.sim.effects.starts import start_from_periods


def add_interpolation_error(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = x + S₁ sin φ + C₁ cos φ + S₂ sin 2φ + C₂ cos 2φ``.

    p: dφ/dq, S₁, C₁, S₂, C₂.
    """
    phase = p[0] * other
    sine, cosine = np.sin(phase), np.cos(phase)
    twice_sine, twice_cosine = 2.0 * sine * cosine, 1.0 - 2.0 * sine * sine
    return x + p[1] * sine + p[2] * cosine + p[3] * twice_sine + p[4] * twice_cosine


def _compute_numbers(values: Values, _facts: AxisProperties) -> tuple[float, ...]:
    harmonics = (values[name] for name in ("sine", "cosine", "second_sine", "second_cosine"))
    return 2.0 * np.pi / values["period"], *harmonics


def _make_amplitude(name: str, meaning: str, typical: float) -> EffectParameter:
    return EffectParameter(name, meaning, "q", -1e-5, 1e-5, typical, linear=True)


# Relative to 20 μm, the usual pitch of a grating; 4, 8, 10 and 40 μm also occur. The fit starts at
# these exact values, because a period that is only nearly right drifts out of phase over records at
# distant positions.
_START_PERIOD_RATIOS = (1.0, 0.2, 0.4, 0.5, 2.0)


ENCODER_INTERPOLATION = Effect(
    id="encoder_interpolation",
    title="Encoder interpolation error",
    summary="Periodic in position with the period of the grating, only in the reading.",
    stage=EffectStage.SENSOR,
    kinds=frozenset({"stepper", "force"}),
    identification=IdentificationHints(
        starts=start_from_periods(*_START_PERIOD_RATIOS),
        # A longer period belongs to a screw.
        domain={"period": (1e-7, 2e-4)},
        moved=make_amplitude_shift(("sine", "cosine"), ("second_sine", "second_cosine")),
    ),
    kinship=EffectRelations(family=EffectFamily.PERIOD),
    formulations=(
        Formulation(
            name="two_harmonics",
            equation="y = q + S₁ sin φ + C₁ cos φ + S₂ sin 2φ + C₂ cos 2φ, φ = 2π q/p",
            source="Heydemann, Applied Optics 20 (1981) 3382–3384",
            parameters=(
                EffectParameter("period", "p, period of the grating", "q", 1e-7, 1e-2, 20e-6),
                _make_amplitude("sine", "S₁, with cosine: offsets of the two signals", 1e-7),
                _make_amplitude("cosine", "C₁", 0.0),
                _make_amplitude(
                    "second_sine", "S₂, with its cosine: unlike gains, phase off 90°", 5e-8
                ),
                _make_amplitude("second_cosine", "C₂", 0.0),
            ),
            acts=ReadingFunction(step=add_interpolation_error),
            prepare=_compute_numbers,
            traits=frozenset(
                {
                    EffectTrait.LOCKED_TO_POSITION,
                    EffectTrait.RATE_INDEPENDENT,
                    EffectTrait.READING_ONLY,
                }
            ),
        ),
    ),
)
