"""The modified model: one-sided dead zones after the plays, for bent or saturating loops.

    y = S[H[x]],   S⁻¹(y) = offset + b₀ y + Σ b_j max(y − d_j, 0),  increasing

Both parts are fitted together, after Kuhnen (European Journal of Control 9 (2003) 407–418, section
4). The fitted difference ``H[x] − S⁻¹(y)`` is linear in all weights. H has the slope 1 from end
to end, because otherwise all weights could be 0. The inverse command is exactly ``H⁻¹[S⁻¹(y)]``.
"""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate.prandtl_ishlinskii import (
    MIN_SLOPE_RATIO,
    PrandtlIshlinskii,
    solve_bounded,
)

DEAD_ZONE_COUNT = 12


class DeadZoneBend(NamedTuple):
    """A bend that consists of one-sided dead zones.

    It is ``offset + slopes₀ y + Σ slopes_i max(y − at_i, 0)``, with shapes (b,) and (b + 1,).
    """

    offset: float
    at: FloatArray
    slopes: FloatArray


def fit_modified(
    radii: FloatArray,
    initial: FloatArray,
    commands: FloatArray,
    plays: FloatArray,
    positions: FloatArray,
) -> tuple[PrandtlIshlinskii, DeadZoneBend]:
    """Fit the plays' weights and the bend to positions (n,) as a function of commands (n,), shares.

    With ``w₀ = 1 − Σ wᵢ`` the equation ``H[x] = S⁻¹(y)`` becomes
    ``x = Σ wᵢ (x − Pᵢ(x)) + S⁻¹(y)``. The unknowns are the slopes of the pieces of S⁻¹, not their
    changes, so bounds can keep it increasing.
    """
    edges = np.linspace(positions.min(), positions.max(), DEAD_ZONE_COUNT + 1)
    breakpoints, piece_length = edges[1:-1], edges[1] - edges[0]
    pieces = np.clip(positions[:, None] - edges[:-1], 0.0, piece_length)
    # The first piece continues below the range, and the last one above it.
    pieces[:, 0] = np.minimum(positions, edges[1])
    pieces[:, -1] = np.maximum(positions - edges[-2], 0.0)
    rows = np.column_stack([commands[:, None] - plays, np.ones_like(commands), pieces])
    lower_bounds = np.concatenate(
        [np.zeros(len(radii)), [-np.inf], np.full(DEAD_ZONE_COUNT, MIN_SLOPE_RATIO)]
    )
    solution = solve_bounded(rows, commands, lower_bounds)
    weights, offset, slopes = np.split(solution, [len(radii), len(radii) + 1])
    # Without a direct term w₀ there is no inverse, so all weights are scaled down if necessary.
    weights *= min(1.0, (1.0 - MIN_SLOPE_RATIO) / max(weights.sum(), MIN_SLOPE_RATIO))
    hysteresis = PrandtlIshlinskii(
        0.0, radii, initial, np.concatenate([[1.0 - weights.sum()], weights])
    )
    return hysteresis, DeadZoneBend(float(offset[0]), breakpoints, np.diff(slopes, prepend=0.0))
