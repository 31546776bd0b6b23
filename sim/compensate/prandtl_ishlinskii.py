"""Prandtl and Ishlinskii's hysteresis, fitted forwards and inverted exactly.

    H[x] = w₀ x + Σ wᵢ Pᵢ(x),   w₀ > 0, wᵢ ≥ 0

Its inverse is of the same form (Kuhnen, European Journal of Control 9 (2003) 407–418, section 3):

    r'ᵢ = w₀ rᵢ + Σ_{j<i} w_j (rᵢ − r_j)
    w'₀ = 1/w₀,  w'ᵢ = −wᵢ / ((w₀ + Σ_{j≤i} w_j) (w₀ + Σ_{j<i} w_j))
    P'ᵢ = Pᵢ Σ_{j≤i} w_j + Σ_{j>i} w_j P_j   at the beginning, at x = 0
"""

from dataclasses import dataclass

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.stops import stops

LEAST_SLOPE = 0.02  # straight after a reversal, of the slope from end to end


@dataclass(frozen=True, slots=True, eq=False)
class Hysteresis:
    """``offset + w₀ x + Σ wᵢ Pᵢ(x)``, shares.

    ``radii`` and ``initial`` (p,) states at x = 0 of the plays, ``weights`` (p + 1,).
    """

    offset: float
    radii: FloatArray
    initial: FloatArray
    weights: FloatArray

    def answer(self, commands: FloatArray) -> FloatArray:
        """Return the output (n,) for ``commands`` (n,), after a rise from 0."""
        plays = commands[:, None] - stops(commands, self.radii, self.initial.copy())
        return np.asarray(self.offset + self.weights[0] * commands + plays @ self.weights[1:])

    def inverse(self) -> "Hysteresis":
        """Return the inverse of all but the offset, exactly."""
        sums = np.cumsum(self.weights)
        before = np.concatenate([[0.0], self.radii[:-1]])
        radii = np.cumsum(sums[:-1] * (self.radii - before))
        weights = -self.weights[1:] / (sums[1:] * sums[:-1])
        moved = self.weights[1:] * self.initial
        initial = self.initial * sums[1:] + moved.sum() - np.cumsum(moved)
        return Hysteresis(0.0, radii, initial, np.concatenate([[1.0 / sums[0]], weights]))

    def consequents(self) -> FloatArray:
        """Return the same as factors (1, 2 + p) of 1, x and the stops x − Pᵢ(x)."""
        return np.concatenate([[self.offset, self.weights.sum()], -self.weights[1:]])[None]


def fit_hysteresis(
    radii: FloatArray,
    initial: FloatArray,
    commands: FloatArray,
    plays: FloatArray,
    positions: FloatArray,
) -> Hysteresis:
    """Fit offset and weights to positions (n,) over commands (n,) and their plays (n, p)."""
    rows = np.column_stack([np.ones_like(commands), commands, plays])
    low = np.concatenate([[-np.inf, LEAST_SLOPE], np.zeros(len(radii))])
    found = bounded(rows, positions, low)
    return Hysteresis(float(found[0]), radii, initial, found[1:])


def bounded(rows: FloatArray, goals: FloatArray, low: FloatArray) -> FloatArray:
    """Return the least squares (c,) of ``rows`` (n, c) for ``goals`` (n,) that are ≥ ``low`` (c,).

    The rows are first reduced to c by QR, which changes no sum of squares but by a constant.
    """
    triangle = np.asarray(np.linalg.qr(np.column_stack([rows, goals]), mode="r"))
    columns = rows.shape[1]
    found = scipy.optimize.lsq_linear(
        triangle[:, :columns], triangle[:, columns], (low, np.inf), method="bvls"
    )
    return np.asarray(found.x)
