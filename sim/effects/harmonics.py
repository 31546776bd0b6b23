"""Error that is periodic in a position: two harmonics, linear in their amplitudes."""

from collections.abc import Callable

import numpy as np

from rotemina.sim.effects.facts import AxisProperties
from rotemina.sim.effects.formulation import Values


def make_amplitude_shift(*pairs: tuple[str, str]) -> Callable[[Values, float], Values]:
    """Return a function that converts amplitudes to another origin of the position.

    ``pairs`` name the sine and cosine amplitude of each harmonic. ``s sin(α + ψ) + c cos(α + ψ)``
    has the amplitudes ``s cos ψ − c sin ψ`` and ``c cos ψ + s sin ψ``.
    """

    def shift_amplitudes(values: Values, offset: float) -> Values:
        shifted = dict(values)
        for k, (sine, cosine) in enumerate(pairs, 1):
            angle = 2.0 * np.pi * k * offset / values["period"]
            s, c = values.get(sine, 0.0), values.get(cosine, 0.0)
            shifted[sine] = float(s * np.cos(angle) - c * np.sin(angle))
            shifted[cosine] = float(c * np.cos(angle) + s * np.sin(angle))
        return shifted

    return shift_amplitudes


def add_two_harmonics(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Add two harmonics of the position.

    p: 2π/period, middle of the range, then sine and cosine amplitude of each harmonic. The second
    one uses ``sin 2α = 2 sin α cos α`` and ``cos 2α = 1 − 2 sin² α``.
    """
    angle = p[0] * (x - p[1])
    sine, cosine = np.sin(angle), np.cos(angle)
    second_harmonic = 2.0 * p[4] * sine * cosine + p[5] * (1.0 - 2.0 * sine * sine)
    return x + p[2] * sine + p[3] * cosine + second_harmonic


def compute_numbers(values: Values, facts: AxisProperties) -> tuple[float, ...]:
    """Return p, with the position counted from the middle of the range.

    From there, an error of the period has the smallest effect.
    """
    return (
        2.0 * np.pi / values["period"],
        0.5 * (facts.low + facts.high),
        values["sine"],
        values["cosine"],
        values["sine_2"],
        values["cosine_2"],
    )
