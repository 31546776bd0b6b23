"""A Preisach plane with a smooth density, evaluated through its Everett function."""

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray

_CELL_COUNT = 200
# Capacity for the turning points that the plane remembers.
_MAX_TURNS = 4000


def draw_plane(rng: np.random.Generator) -> FloatArray:
    """Draw a density over switching thresholds α ≥ β, and integrate it to the Everett function.

    Element [i, j] of the result is the change of the output when the input rises from j/n to i/n
    (i ≥ j). Inputs and outputs are in [0, 1].
    """
    threshold = (np.arange(_CELL_COUNT) + 0.5) / _CELL_COUNT
    upper, lower = np.meshgrid(threshold, threshold, indexing="ij")
    middle, width = (upper + lower) / 2.0, upper - lower
    density_centre, spread = rng.uniform(0.35, 0.65), rng.uniform(0.3, 0.9)
    decay_width = rng.uniform(0.05, 0.25)
    density = np.exp(-(((middle - density_centre) / spread) ** 2)) * (
        np.maximum(width, 0.0) / decay_width
    ) ** rng.uniform(0.0, 0.8)
    density *= np.exp(-np.maximum(width, 0.0) / decay_width) * (width >= 0.0)
    # Everett(α, β) is the mass of the triangle β ≤ β' ≤ α' ≤ α.
    cumulative = np.zeros((_CELL_COUNT + 1, _CELL_COUNT + 1))
    cumulative[1:, 1:] = np.cumsum(np.cumsum(np.nan_to_num(density)[:, ::-1], axis=1), axis=0)
    everett = cumulative[:, ::-1].copy()
    return np.asarray(everett / everett[_CELL_COUNT, 0])


@numba.njit(cache=True, error_model="numpy")
def _interpolate_everett(everett: FloatArray, high: float, low: float) -> float:
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
    """Return the output (n,) of the plane, in [0, 1], for ``inputs`` (n,).

    The input starts below all thresholds and rises to the first of ``inputs``.
    """
    # Inputs at which the direction reversed, and the outputs at these points.
    turn_inputs = np.zeros(_MAX_TURNS)
    turn_outputs = np.zeros(_MAX_TURNS)
    depth, is_rising, last_input = 1, True, 0.0
    out = np.empty_like(inputs)
    value = 0.0
    for k in range(len(inputs)):
        x = min(max(inputs[k], 0.0), 1.0)
        if x != last_input and (x > last_input) != is_rising and depth < _MAX_TURNS - 1:
            turn_inputs[depth], turn_outputs[depth] = last_input, value
            depth += 1
            is_rising = x > last_input
        # An input beyond an earlier turning point erases that turning point and the next one.
        while depth > 2 and (
            x >= turn_inputs[depth - 2] if is_rising else x <= turn_inputs[depth - 2]
        ):
            depth -= 2
        if depth == 2 and not is_rising and x <= turn_inputs[0]:
            depth, is_rising = 1, True
        if depth == 1 and not is_rising:
            is_rising = True
        turn_input = turn_inputs[depth - 1]
        if is_rising:
            value = turn_outputs[depth - 1] + _interpolate_everett(everett, x, turn_input)
        else:
            value = turn_outputs[depth - 1] - _interpolate_everett(everett, turn_input, x)
        last_input = x
        out[k] = value
    return out
