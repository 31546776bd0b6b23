"""A Preisach plane with a smooth density, evaluated through its Everett function."""

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray

_CELLS = 200
_DEEPEST = 4000


def draw_plane(rng: np.random.Generator) -> FloatArray:
    """Draw a density over switching thresholds α ≥ β, and integrate it to the Everett function.

    Return the output change from input j/n up to i/n (i ≥ j), [i, j], for a plane on [0, 1].
    """
    centre = (np.arange(_CELLS) + 0.5) / _CELLS
    up, down = np.meshgrid(centre, centre, indexing="ij")
    middle, width = (up + down) / 2.0, up - down
    at, spread = rng.uniform(0.35, 0.65), rng.uniform(0.3, 0.9)
    reach = rng.uniform(0.05, 0.25)
    density = np.exp(-(((middle - at) / spread) ** 2)) * (
        np.maximum(width, 0.0) / reach
    ) ** rng.uniform(0.0, 0.8)
    density *= np.exp(-np.maximum(width, 0.0) / reach) * (width >= 0.0)
    # Everett(α, β): mass of the triangle β ≤ β' ≤ α' ≤ α.
    whole = np.zeros((_CELLS + 1, _CELLS + 1))
    whole[1:, 1:] = np.cumsum(np.cumsum(np.nan_to_num(density)[:, ::-1], axis=1), axis=0)
    everett = whole[:, ::-1].copy()
    return np.asarray(everett / everett[_CELLS, 0])


@numba.njit(cache=True, error_model="numpy")
def _mass(everett: FloatArray, high: float, low: float) -> float:
    n = everett.shape[0] - 1
    a, b = min(max(high, 0.0), 1.0) * n, min(max(low, 0.0), 1.0) * n
    i, j = min(int(a), n - 1), min(int(b), n - 1)
    s, t = a - i, b - j
    return float(
        everett[i, j] * (1.0 - s) * (1.0 - t)
        + everett[i + 1, j] * s * (1.0 - t)
        + everett[i, j + 1] * (1.0 - s) * t
        + everett[i + 1, j + 1] * s * t
    )


@numba.njit(cache=True, error_model="numpy")
def run_plane(everett: FloatArray, inputs: FloatArray) -> FloatArray:
    """Return the plane's output in [0, 1] for ``inputs`` (n,), which start from below all."""
    turns = np.zeros(_DEEPEST)  # input values at which the staircase line turns
    sums = np.zeros(_DEEPEST)  # the output there
    depth, rising, last = 1, True, 0.0
    out = np.empty_like(inputs)
    value = 0.0
    for k in range(len(inputs)):
        x = min(max(inputs[k], 0.0), 1.0)
        if x != last and (x > last) != rising and depth < _DEEPEST - 1:
            turns[depth], sums[depth] = last, value
            depth += 1
            rising = x > last
        while depth > 2 and (x >= turns[depth - 2] if rising else x <= turns[depth - 2]):
            depth -= 2
        if depth == 2 and not rising and x <= turns[0]:
            depth, rising = 1, True
        if depth == 1 and not rising:
            rising = True
        base = turns[depth - 1]
        if rising:
            value = sums[depth - 1] + _mass(everett, x, base)
        else:
            value = sums[depth - 1] - _mass(everett, base, x)
        last = x
        out[k] = value
    return out
