"""Vibration from outside, such as from the floor or a fan: periodic in time."""

from collections.abc import Iterator

import numpy as np

from rotemina.sim.effects.facts import AxisProperties
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
from rotemina.sim.effects.identification import (
    EffectSignature,
    FitView,
    IdentificationHints,
    Interval,
    RecordCoverage,
)
from rotemina.sim.effects.kinship import EffectRelations


def add_tone(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = x + s₁ sin 2πft + c₁ cos 2πft``. p: 2πf, s₁, c₁."""
    angle = p[0] * t
    return x + p[1] * np.sin(angle) + p[2] * np.cos(angle)


def add_two_tones(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Add a tone and its second harmonic. p: 2πf, s₁, c₁, s₂, c₂."""
    sine, cosine = np.sin(p[0] * t), np.cos(p[0] * t)
    second_harmonic = 2.0 * p[3] * sine * cosine + p[4] * (1.0 - 2.0 * sine * sine)
    return x + p[1] * sine + p[2] * cosine + second_harmonic


def _compute_numbers(values: Values, _facts: AxisProperties) -> tuple[float, ...]:
    amplitudes = [
        values[name] for name in ("sine", "cosine", "sine_2", "cosine_2") if name in values
    ]
    return (2.0 * np.pi * values["frequency"], *amplitudes)


def _make_amplitude(name: str, meaning: str, typical: float) -> EffectParameter:
    return EffectParameter(name, meaning, "q", -0.1, 0.1, typical, per="span", linear=True)


_TONE = (
    EffectParameter("frequency", "f", "Hz", 0.1, 2000.0, 50.0),
    _make_amplitude("sine", "s₁, zero at the start of the run", 1e-4),
    _make_amplitude("cosine", "c₁, maximum at the start of the run", 0.0),
)
_SOURCE = "Harris and Piersol, Shock and Vibration Handbook, 5th ed. (2002)"

# A record must contain this many periods: with fewer, any slow change looks periodic.
_MIN_PERIODS_PER_RECORD = 3.0


def _start_from_lines(view: FitView) -> Iterator[Values]:
    frequency = view.frequency(view.domain("frequency"))
    yield {"frequency": frequency or view.values["frequency"]}


def _limit_frequency(
    _values: Values, _facts: AxisProperties, bounds: Interval, extent: RecordCoverage
) -> Interval:
    """Return the frequencies, Hz, with at least a few periods in the longest record."""
    low, high = bounds
    return min(max(low, _MIN_PERIODS_PER_RECORD / extent.longest_s), high), high


VIBRATION = Effect(
    id="vibration",
    title="Vibration",
    summary="Periodic in time, regardless of position and command.",
    stage=EffectStage.MECHANICS,
    kinds=EVERY_KIND,
    identification=IdentificationHints(
        starts=_start_from_lines,
        domain={"frequency": _limit_frequency},
        of_the_record=frozenset({"sine", "cosine", "sine_2", "cosine_2"}),
        shows_as=EffectSignature.TONES,
    ),
    kinship=EffectRelations(prior=0.5),
    formulations=(
        Formulation(
            name="tone",
            equation="y = x + s₁ sin 2πft + c₁ cos 2πft, t since the run began",
            source=_SOURCE,
            parameters=_TONE,
            acts=PositionFunction(step=add_tone),
            prepare=_compute_numbers,
            traits=frozenset({EffectTrait.LOCKED_TO_TIME}),
        ),
        Formulation(
            name="two_tones",
            equation="y = x + s₁ sin 2πft + c₁ cos 2πft + s₂ sin 4πft + c₂ cos 4πft",
            source=_SOURCE,
            parameters=(
                *_TONE,
                _make_amplitude("sine_2", "s₂, second harmonic", 5e-5),
                _make_amplitude("cosine_2", "c₂, second harmonic", 0.0),
            ),
            acts=PositionFunction(step=add_two_tones),
            prepare=_compute_numbers,
            traits=frozenset({EffectTrait.LOCKED_TO_TIME}),
        ),
    ),
)
