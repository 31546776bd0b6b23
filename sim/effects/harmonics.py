"""An error that is periodic in a position: two harmonics, linear in their amplitudes."""

from collections.abc import Callable

import numpy as np

from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import Values


def moved(*pairs: tuple[str, str]) -> Callable[[Values, float], Values]:
    """Return how amplitudes turn where the place is counted from elsewhere, harmonic by harmonic.

    ``s sin(α + ψ) + c cos(α + ψ)`` has amplitudes ``s cos ψ − c sin ψ`` and ``c cos ψ + s sin ψ``.
    """

    def turned(values: Values, by: float) -> Values:
        found = dict(values)
        for k, (sine, cosine) in enumerate(pairs, 1):
            angle = 2.0 * np.pi * k * by / values["period"]
            s, c = values.get(sine, 0.0), values.get(cosine, 0.0)
            found[sine] = float(s * np.cos(angle) - c * np.sin(angle))
            found[cosine] = float(c * np.cos(angle) + s * np.sin(angle))
        return found

    return turned


def two_harmonics(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Add two harmonics of the position.

    p: 2π/period, middle of the range, then sine and cosine amplitude of each. Of the second
    harmonic, ``sin 2α = 2 sin α cos α`` and ``cos 2α = 1 − 2 sin² α``.
    """
    angle = p[0] * (x - p[1])
    sine, cosine = np.sin(angle), np.cos(angle)
    second = 2.0 * p[4] * sine * cosine + p[5] * (1.0 - 2.0 * sine * sine)
    return x + p[2] * sine + p[3] * cosine + second


def from_mid_range(values: Values, facts: Facts) -> tuple[float, ...]:
    """Return p, counted from the middle of the range: there a wrong period does least harm."""
    return (
        2.0 * np.pi / values["period"],
        0.5 * (facts.low + facts.high),
        values["sine"],
        values["cosine"],
        values["sine_2"],
        values["cosine_2"],
    )
