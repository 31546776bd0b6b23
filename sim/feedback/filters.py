"""Second-order filters of a sampled signal.

They are discretised by Tustin's rule, prewarped so that their frequency is exact (Franklin, Powell
and Workman, "Digital Control of Dynamic Systems", 3rd ed. (1998), sec. 6.1)::

    s = K (1 − z⁻¹)/(1 + z⁻¹),   K = ω / tan(ω h / 2)
"""

from math import pi, sqrt, tan
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import ComplexArray
from rotemina.sim.errors import FeedbackError


class Biquad(NamedTuple):
    """The filter ``(b0 + b1 z⁻¹ + b2 z⁻²) / (1 + a1 z⁻¹ + a2 z⁻²)``."""

    b0: float
    b1: float
    b2: float
    a1: float
    a2: float

    def compute_response(self, z: ComplexArray) -> ComplexArray:
        """Return the frequency response (…,) at points of the unit circle."""
        z_inverse = 1.0 / z
        numerator = self.b0 + z_inverse * (self.b1 + z_inverse * self.b2)
        return np.asarray(numerator / (1.0 + z_inverse * (self.a1 + z_inverse * self.a2)))


PASS_THROUGH = Biquad(1.0, 0.0, 0.0, 0.0, 0.0)
"""A filter that does not change a signal."""


def design_notch(frequency_hz: float, damping: float, depth: float, rate_hz: float) -> Biquad:
    """Return a notch: ``(s² + 2 d ζ ω s + ω²) / (s² + 2 ζ ω s + ω²)``.

    Its gain is d at ω and 1 far from it.

    Raises
    ------
    FeedbackError
        If the frequency is not below half the rate.
    """
    k = _prewarp("notch", frequency_hz, rate_hz)
    return _discretise((1.0, 2.0 * depth * damping, 1.0), (1.0, 2.0 * damping, 1.0), k)


def design_low_pass(frequency_hz: float, rate_hz: float) -> Biquad:
    """Return Butterworth's low-pass of second order: ``ω² / (s² + √2 ω s + ω²)``.

    Raises
    ------
    FeedbackError
        If the frequency is not below half the rate.
    """
    k = _prewarp("low-pass", frequency_hz, rate_hz)
    return _discretise((0.0, 0.0, 1.0), (1.0, sqrt(2.0), 1.0), k)


def _prewarp(name: str, frequency_hz: float, rate_hz: float) -> float:
    """Return the substitution factor K/ω."""
    if not 0.0 < frequency_hz < 0.5 * rate_hz:
        raise FeedbackError(
            "{name} at {frequency_hz} Hz: must lie above 0 and below half the loop's "
            "rate, {rate_hz} Hz",
            name=name,
            frequency_hz=frequency_hz,
            rate_hz=0.5 * rate_hz,
        )
    return 1.0 / tan(pi * frequency_hz / rate_hz)


def _discretise(
    numerator: tuple[float, float, float], denominator: tuple[float, float, float], k: float
) -> Biquad:
    """Discretise a ratio of polynomials ``c₂ s² + c₁ s + c₀``, given as (c₂, c₁, c₀).

    s is in units of ω, and is replaced by k (1 − z⁻¹)/(1 + z⁻¹).
    """
    b, a = (
        (
            c[0] * k * k + c[1] * k + c[2],
            2.0 * (c[2] - c[0] * k * k),
            c[0] * k * k - c[1] * k + c[2],
        )
        for c in (numerator, denominator)
    )
    return Biquad(b[0] / a[0], b[1] / a[0], b[2] / a[0], a[1] / a[0], a[2] / a[0])
