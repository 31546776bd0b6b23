"""Vibration from outside, of the floor or of a fan: periodic in time."""

from collections.abc import Iterator

import numpy as np

from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    Formulation,
    Motion,
    Parameter,
    Stage,
    Trait,
    Values,
)
from rotemina.sim.effects.identification import Extent, Identification, Interval, Sign, View
from rotemina.sim.effects.kinship import Kinship


def tone(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = x + s₁ sin 2πft + c₁ cos 2πft``. p: 2πf, s₁, c₁."""
    angle = p[0] * t
    return x + p[1] * np.sin(angle) + p[2] * np.cos(angle)


def two_tones(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Add a tone and its second harmonic. p: 2πf, s₁, c₁, s₂, c₂."""
    sine, cosine = np.sin(p[0] * t), np.cos(p[0] * t)
    second = 2.0 * p[3] * sine * cosine + p[4] * (1.0 - 2.0 * sine * sine)
    return x + p[1] * sine + p[2] * cosine + second


def _numbers(values: Values, _facts: Facts) -> tuple[float, ...]:
    amplitudes = [
        values[name] for name in ("sine", "cosine", "sine_2", "cosine_2") if name in values
    ]
    return (2.0 * np.pi * values["frequency"], *amplitudes)


def _amplitude(name: str, meaning: str, typical: float) -> Parameter:
    return Parameter(name, meaning, "q", -0.1, 0.1, typical, per="span", linear=True)


_TONE = (
    Parameter("frequency", "f", "Hz", 0.1, 2000.0, 50.0),
    _amplitude("sine", "s₁, zero at the start of the run", 1e-4),
    _amplitude("cosine", "c₁, maximum at the start of the run", 0.0),
)
_SOURCE = "Harris and Piersol, Shock and Vibration Handbook, 5th ed. (2002)"

_PERIODS = 3.0  # that a record holds of what is periodic: less of it is any slow change


def _lines(view: View) -> Iterator[Values]:
    seen = view.frequency(view.domain("frequency"))
    yield {"frequency": seen or view.values["frequency"]}


def _seen_to_return(_values: Values, _facts: Facts, bounds: Interval, extent: Extent) -> Interval:
    """Return frequencies, in Hz, with at least a few periods in a record."""
    low, high = bounds
    return min(max(low, _PERIODS / extent.longest_s), high), high


VIBRATION = Effect(
    id="vibration",
    title="Vibration",
    summary="Periodic in time, regardless of position and command.",
    stage=Stage.MECHANICS,
    kinds=EVERY_KIND,
    identification=Identification(
        starts=_lines,
        domain={"frequency": _seen_to_return},
        of_the_record=frozenset({"sine", "cosine", "sine_2", "cosine_2"}),
        shows_as=Sign.TONES,
    ),
    kinship=Kinship(prior=0.5),
    formulations=(
        Formulation(
            name="tone",
            equation="y = x + s₁ sin 2πft + c₁ cos 2πft, t since the run began",
            source=_SOURCE,
            parameters=_TONE,
            acts=Motion(step=tone),
            prepare=_numbers,
            traits=frozenset({Trait.LOCKED_TO_TIME}),
        ),
        Formulation(
            name="two_tones",
            equation="y = x + s₁ sin 2πft + c₁ cos 2πft + s₂ sin 4πft + c₂ cos 4πft",
            source=_SOURCE,
            parameters=(
                *_TONE,
                _amplitude("sine_2", "s₂, second harmonic", 5e-5),
                _amplitude("cosine_2", "c₂, second harmonic", 0.0),
            ),
            acts=Motion(step=two_tones),
            prepare=_numbers,
            traits=frozenset({Trait.LOCKED_TO_TIME}),
        ),
    ),
)
