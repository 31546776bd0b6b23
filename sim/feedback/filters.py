"""Second-order filters of a sampled signal.

Made of their continuous forms by Tustin's rule, warped so that the frequency they are named by is
met exactly (Franklin, Powell and Workman, "Digital Control of Dynamic Systems", 3rd ed. (1998),
sec. 6.1)::

    s = K (1 − z⁻¹)/(1 + z⁻¹),   K = ω / tan(ω h / 2)
"""

from math import pi, sqrt, tan
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import ComplexArray
from rotemina.sim.feedback.errors import FeedbackError
from rotemina.sim.messages import message


class Biquad(NamedTuple):
    """``(b0 + b1 z⁻¹ + b2 z⁻²) / (1 + a1 z⁻¹ + a2 z⁻²)``."""

    b0: float
    b1: float
    b2: float
    a1: float
    a2: float

    def response(self, z: ComplexArray) -> ComplexArray:
        """Return the frequency response (…,) at points of the unit circle."""
        back = 1.0 / z
        above = self.b0 + back * (self.b1 + back * self.b2)
        return np.asarray(above / (1.0 + back * (self.a1 + back * self.a2)))


THROUGH = Biquad(1.0, 0.0, 0.0, 0.0, 0.0)
"""Leaves a signal as it is."""


def notch(frequency_hz: float, damping: float, depth: float, rate_hz: float) -> Biquad:
    """Return ``(s² + 2 d ζ ω s + ω²) / (s² + 2 ζ ω s + ω²)``: gain d at ω, 1 far from it.

    Raises
    ------
    FeedbackError
        If the frequency is not below half the rate.
    """
    warped = _warped("notch", frequency_hz, rate_hz)
    return _sampled((1.0, 2.0 * depth * damping, 1.0), (1.0, 2.0 * damping, 1.0), warped)


def low_pass(frequency_hz: float, rate_hz: float) -> Biquad:
    """Return ``ω² / (s² + √2 ω s + ω²)``: Butterworth's of second order.

    Raises
    ------
    FeedbackError
        If the frequency is not below half the rate.
    """
    warped = _warped("low-pass", frequency_hz, rate_hz)
    return _sampled((0.0, 0.0, 1.0), (1.0, sqrt(2.0), 1.0), warped)


def _warped(name: str, frequency_hz: float, rate_hz: float) -> float:
    """Return K/ω."""
    if not 0.0 < frequency_hz < 0.5 * rate_hz:
        raise FeedbackError(
            message(
                "engine",
                "{name} at {frequency_hz} Hz: must lie above 0 and below half the loop's "
                "rate, {rate_hz} Hz",
            ).fill(name=name, frequency_hz=frequency_hz, rate_hz=0.5 * rate_hz)
        )
    return 1.0 / tan(pi * frequency_hz / rate_hz)


def _sampled(
    above: tuple[float, float, float], below: tuple[float, float, float], k: float
) -> Biquad:
    """Sample a ratio of ``c₂ s² + c₁ s + c₀`` in the unit of ω, with s = k (1 − z⁻¹)/(1 + z⁻¹)."""
    b, a = (
        (
            c[0] * k * k + c[1] * k + c[2],
            2.0 * (c[2] - c[0] * k * k),
            c[0] * k * k - c[1] * k + c[2],
        )
        for c in (above, below)
    )
    return Biquad(b[0] / a[0], b[1] / a[0], b[2] / a[0], a[1] / a[0], a[2] / a[0])
