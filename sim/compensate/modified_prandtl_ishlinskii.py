"""The modified form: one-sided dead zones after the plays, for bent or saturating loops.

    y = S[H[x]],   S⁻¹(y) = offset + b₀ y + Σ b_j max(y − d_j, 0),  increasing

Fitted at once as Kuhnen does (European Journal of Control 9 (2003) 407–418, section 4), as the
difference ``H[x] − S⁻¹(y)``, which is linear in all weights, with H from end to end 1 so that they
do not all vanish. The inverse command is exactly ``H⁻¹[S⁻¹(y)]``.
"""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate.prandtl_ishlinskii import LEAST_SLOPE, Hysteresis, bounded

DEAD_ZONES = 12


class Bend(NamedTuple):
    """``offset + slopes₀ y + Σ slopes_i max(y − at_i, 0)``; (b,), (b + 1,)."""

    offset: float
    at: FloatArray
    slopes: FloatArray


def fit_modified(
    radii: FloatArray,
    initial: FloatArray,
    commands: FloatArray,
    plays: FloatArray,
    positions: FloatArray,
) -> tuple[Hysteresis, Bend]:
    """Fit the plays' weights and the bend behind them to positions (n,) over commands (n,), shares.

    With ``w₀ = 1 − Σ wᵢ`` the equation ``H[x] = S⁻¹(y)`` reads
    ``x = Σ wᵢ (x − Pᵢ(x)) + S⁻¹(y)``. Piecewise slopes of S⁻¹, not their changes, are the unknowns,
    so that bounds keep it increasing.
    """
    edges = np.linspace(positions.min(), positions.max(), DEAD_ZONES + 1)
    at, length = edges[1:-1], edges[1] - edges[0]
    stretches = np.clip(positions[:, None] - edges[:-1], 0.0, length)
    stretches[:, 0] = np.minimum(positions, edges[1])  # goes on below, as the last one above
    stretches[:, -1] = np.maximum(positions - edges[-2], 0.0)
    rows = np.column_stack([commands[:, None] - plays, np.ones_like(commands), stretches])
    low = np.concatenate([np.zeros(len(radii)), [-np.inf], np.full(DEAD_ZONES, LEAST_SLOPE)])
    found = bounded(rows, commands, low)
    weights, offset, slopes = np.split(found, [len(radii), len(radii) + 1])
    # Plays that together leave no direct share have no inverse: take of all alike.
    weights *= min(1.0, (1.0 - LEAST_SLOPE) / max(weights.sum(), LEAST_SLOPE))
    whole = Hysteresis(0.0, radii, initial, np.concatenate([[1.0 - weights.sum()], weights]))
    return whole, Bend(float(offset[0]), at, np.diff(slopes, prepend=0.0))
