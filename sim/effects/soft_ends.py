"""Fit of an amplifier's saturation to its output voltages."""

from typing import NamedTuple

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray

_MAX_ROW_COUNT = 5000
# Softness values from which the fit is started.
_START_SOFTNESS = (0.03, 0.1, 0.3)
_MAX_SOFTNESS = 0.5
# Margins by which the first limits exceed the observed voltages, relative to their range.
_START_MARGIN_RATIOS = (0.02, 0.3)


class AmplifierLimits(NamedTuple):
    """Limits of an amplifier's output, V, and their softness."""

    low: float
    high: float
    softness: float

    def without_low(self, low: float) -> "AmplifierLimits":
        """Return a copy limited only at the high end; its low limit is ``low`` or lower."""
        return self._with_range(min(self.low, low), self.high)

    def without_high(self, high: float) -> "AmplifierLimits":
        """Return a copy limited only at the low end; its high limit is ``high`` or higher."""
        return self._with_range(self.low, max(self.high, high))

    def _with_range(self, low: float, high: float) -> "AmplifierLimits":
        # Softness is relative to the range, so the same bend in V is less soft in a wider range.
        return AmplifierLimits(low, high, self.softness * (self.high - self.low) / (high - low))


def fit_limits(
    requested: FloatArray, output: FloatArray, output_range: tuple[float, float]
) -> AmplifierLimits:
    """Fit the soft saturation by which ``output`` (n,) follows ``requested`` (n,), V.

    ``output_range`` is the smallest and largest output. The curve is that of the effect
    *saturation*; lags between the two signals count as noise.
    """
    stride = max(len(requested) // _MAX_ROW_COUNT, 1)
    x, y = requested[::stride], output[::stride]
    low, high = output_range
    span = high - low

    def compute_residual(p: FloatArray) -> FloatArray:
        return _apply_soft_limits(x, p[0], p[1], p[2]) - y

    fits = [
        scipy.optimize.least_squares(
            compute_residual,
            (low - margin_ratio * span, high + margin_ratio * span, softness),
            bounds=(
                (low - 2.0 * span, high - 0.1 * span, 1e-3),
                (low + 0.1 * span, high + 2.0 * span, _MAX_SOFTNESS),
            ),
            x_scale=(span, span, 0.1),
        )
        for margin_ratio in _START_MARGIN_RATIOS
        for softness in _START_SOFTNESS
    ]
    best = min(fits, key=lambda fit: fit.cost)
    return AmplifierLimits(*(float(value) for value in best.x))


def _apply_soft_limits(x: FloatArray, low: float, high: float, softness: float) -> FloatArray:
    """Return ``c + A v (1 + |v|ⁿ)^(−1/n)`` (n,), v = (x − c)/A, 1/n the softness."""
    middle, half_range = 0.5 * (low + high), 0.5 * (high - low)
    v = (x - middle) / half_range
    magnitude = np.abs(v)
    # Factor the larger of 1 and |v| out of the root, so that no power overflows.
    ratio = np.minimum(magnitude, 1.0) / np.maximum(magnitude, 1.0)
    root = np.exp(-softness * np.log1p(ratio ** (1.0 / softness)))
    return np.asarray(middle + half_range * np.sign(v) * np.minimum(magnitude, 1.0) * root)
