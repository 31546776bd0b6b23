"""Characteristic that is curved over a section of the range, as a sine series."""

import numpy as np

from rotemina.sim.effects.formulation import EffectParameter, Values

EQUATION = "y = x + S Σ aₖ sin kπz, k = 1…4, z = 0…1 along the stretch; y = x outside"
SOURCE = (
    "Pintelon and Schoukens, System Identification, 2nd ed. (2012), ch. 3: static nonlinearities"
)
_SINE_NAMES = ("sine_1", "sine_2", "sine_3", "sine_4")


def add_sine_series(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Return ``y = x + Σ p[1+k] sin kπz``, z = (x − p[0])·p[1].

    p: begin, 1/length, four amplitudes.
    """
    z = (x - p[0]) * p[1]
    if z <= 0.0 or z >= 1.0:
        return x
    sine, twice_cosine = np.sin(np.pi * z), 2.0 * np.cos(np.pi * z)
    second_harmonic = twice_cosine * sine
    third_harmonic = twice_cosine * second_harmonic - sine
    return (
        x
        + p[2] * sine
        + p[3] * second_harmonic
        + p[4] * third_harmonic
        + p[5] * (twice_cosine * third_harmonic - second_harmonic)
    )


def make_parameters() -> tuple[EffectParameter, ...]:
    """Return the parameters: the section and the amplitudes, all relative to the range."""
    return (
        EffectParameter(
            "begin", "start of the section, from the low end of the range", "", 0.0, 1.0, 0.0
        ),
        EffectParameter("end", "end of the section", "", 0.0, 1.0, 1.0),
        EffectParameter(_SINE_NAMES[0], "a₁, curvature", "", -0.2, 0.2, 0.005, linear=True),
        *(
            EffectParameter(name, f"a{k}", "", -0.2, 0.2, 0.0, linear=True)
            for name, k in zip(_SINE_NAMES[1:], "₂₃₄", strict=True)
        ),
    )


def compute_numbers(values: Values, low: float, span: float) -> tuple[float, ...]:
    """Return ``p`` of :func:`add_sine_series`, over a range from ``low`` of length ``span``."""
    length = (values["end"] - values["begin"]) * span
    amplitudes = (span * values[name] for name in _SINE_NAMES)
    return low + values["begin"] * span, 1.0 / length if length > 0.0 else 0.0, *amplitudes
