"""The saturation of an amplifier, estimated from its output voltages."""

from typing import NamedTuple

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray

_MOST_ROWS = 5000
_SOFTNESS = (0.03, 0.1, 0.3)  # from which it is tried
_SOFTEST = 0.5
_BEYOND = (0.02, 0.3)  # of what was seen, that an end may lie further out


class Bend(NamedTuple):
    """The limits of an amplifier's output, V, and their softness."""

    low: float
    high: float
    softness: float

    def without_low(self, low: float) -> "Bend":
        """Return the same bend only at the high end; the other lies at ``low`` or beyond."""
        return self._stretched(min(self.low, low), self.high)

    def without_high(self, high: float) -> "Bend":
        """Return the same bend only at the low end; the other lies at ``high`` or beyond."""
        return self._stretched(self.low, max(self.high, high))

    def _stretched(self, low: float, high: float) -> "Bend":
        # As wide a bend, V, is a smaller share of a longer way.
        return Bend(low, high, self.softness * (self.high - self.low) / (high - low))


def bent_ends(asked: FloatArray, given: FloatArray, seen: tuple[float, float]) -> Bend:
    """Return the soft saturation with which ``given`` (n,) best follows ``asked`` (n,), V.

    ``seen`` are the smallest and largest outputs. The curve is that of the effect *saturation*;
    lags between the two count as noise.
    """
    stride = max(len(asked) // _MOST_ROWS, 1)
    x, y = asked[::stride], given[::stride]
    low, high = seen
    reach = high - low

    def off(p: FloatArray) -> FloatArray:
        return _softly(x, p[0], p[1], p[2]) - y

    found = [
        scipy.optimize.least_squares(
            off,
            (low - beyond * reach, high + beyond * reach, softness),
            bounds=(
                (low - 2.0 * reach, high - 0.1 * reach, 1e-3),
                (low + 0.1 * reach, high + 2.0 * reach, _SOFTEST),
            ),
            x_scale=(reach, reach, 0.1),
        )
        for beyond in _BEYOND
        for softness in _SOFTNESS
    ]
    best = min(found, key=lambda one: one.cost)
    return Bend(*(float(value) for value in best.x))


def _softly(x: FloatArray, low: float, high: float, softness: float) -> FloatArray:
    """Return ``c + A v (1 + |v|ⁿ)^(−1/n)`` (n,), v = (x − c)/A, 1/n the softness."""
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    v = (x - middle) / half
    size = np.abs(v)
    # The larger of one and |v| is taken out of the root, so that no power overflows.
    ratio = np.minimum(size, 1.0) / np.maximum(size, 1.0)
    root = np.exp(-softness * np.log1p(ratio ** (1.0 / softness)))
    return np.asarray(middle + half * np.sign(v) * np.minimum(size, 1.0) * root)
