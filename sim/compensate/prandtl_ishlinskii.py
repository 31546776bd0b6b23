"""The hysteresis model of Prandtl and Ishlinskii, fitted forwards and inverted exactly.

    H[x] = w₀ x + Σ wᵢ Pᵢ(x),   w₀ > 0, wᵢ ≥ 0

Its inverse has the same form (Kuhnen, European Journal of Control 9 (2003) 407–418, section 3):

    r'ᵢ = w₀ rᵢ + Σ_{j<i} w_j (rᵢ − r_j)
    w'₀ = 1/w₀,  w'ᵢ = −wᵢ / ((w₀ + Σ_{j≤i} w_j) (w₀ + Σ_{j<i} w_j))
    P'ᵢ = Pᵢ Σ_{j≤i} w_j + Σ_{j>i} w_j P_j   initially, at x = 0
"""

from dataclasses import dataclass

import numba
import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray

# Smallest ratio of the slope just after a reversal to the slope from end to end.
MIN_SLOPE_RATIO = 0.02


@numba.njit(cache=True, error_model="numpy")
def compute_stops(x: FloatArray, radii: FloatArray, state: FloatArray) -> FloatArray:
    """Return the stop operators ``E_r(x)`` (n, k) for x (n,) and ``radii`` r (k,).

    ``E_r(x) = x − P_r(x)`` with the play ``P_r = max(x − r, min(x + r, P_r))``: the output follows
    x and stops at ±r. The Prandtl–Ishlinskii model is also a straight line plus a weighted sum of
    stops. Its loop is ``2 Σ w r`` wide.

    ``state`` (k,) holds the plays before the first sample and is updated to those after the last.
    """
    result = np.empty((len(x), len(radii)))
    for row in range(len(x)):
        for column in range(len(radii)):
            r = radii[column]
            state[column] = max(x[row] - r, min(x[row] + r, state[column]))
            result[row, column] = x[row] - state[column]
    return result


@dataclass(frozen=True, slots=True, eq=False)
class PrandtlIshlinskii:
    """The operator ``offset + w₀ x + Σ wᵢ Pᵢ(x)``, in shares.

    ``radii`` (p,) and ``initial`` (p,), the states at x = 0, are those of the plays. ``weights`` is
    (p + 1,).
    """

    offset: float
    radii: FloatArray
    initial: FloatArray
    weights: FloatArray

    def compute_output(self, commands: FloatArray) -> FloatArray:
        """Return the output (n,) for ``commands`` (n,), after a rise from 0."""
        plays = commands[:, None] - compute_stops(commands, self.radii, self.initial.copy())
        return np.asarray(self.offset + self.weights[0] * commands + plays @ self.weights[1:])

    def make_inverse(self) -> "PrandtlIshlinskii":
        """Return the exact inverse of the operator without its offset."""
        sums = np.cumsum(self.weights)
        previous_radii = np.concatenate([[0.0], self.radii[:-1]])
        radii = np.cumsum(sums[:-1] * (self.radii - previous_radii))
        weights = -self.weights[1:] / (sums[1:] * sums[:-1])
        weighted = self.weights[1:] * self.initial
        initial = self.initial * sums[1:] + weighted.sum() - np.cumsum(weighted)
        return PrandtlIshlinskii(0.0, radii, initial, np.concatenate([[1.0 / sums[0]], weights]))

    def to_consequents(self) -> FloatArray:
        """Return the factors (1, 2 + p) of 1, x and the stops x − Pᵢ(x)."""
        return np.concatenate([[self.offset, self.weights.sum()], -self.weights[1:]])[None]


def fit_hysteresis(
    radii: FloatArray,
    initial: FloatArray,
    commands: FloatArray,
    plays: FloatArray,
    positions: FloatArray,
) -> PrandtlIshlinskii:
    """Fit offset and weights to positions (n,) for commands (n,) and their plays (n, p)."""
    rows = np.column_stack([np.ones_like(commands), commands, plays])
    lower_bounds = np.concatenate([[-np.inf, MIN_SLOPE_RATIO], np.zeros(len(radii))])
    solution = solve_bounded(rows, positions, lower_bounds)
    return PrandtlIshlinskii(float(solution[0]), radii, initial, solution[1:])


def solve_bounded(rows: FloatArray, goals: FloatArray, low: FloatArray) -> FloatArray:
    """Return the least-squares solution (c,) of ``rows`` (n, c) for ``goals`` (n,).

    Each coefficient is at least ``low`` (c,). QR first reduces the rows to c + 1, which does not
    change the solution.
    """
    triangle = np.asarray(np.linalg.qr(np.column_stack([rows, goals]), mode="r"))
    columns = rows.shape[1]
    result = scipy.optimize.lsq_linear(
        triangle[:, :columns], triangle[:, columns], (low, np.inf), method="bvls"
    )
    return np.asarray(result.x)
