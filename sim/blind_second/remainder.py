"""A remainder that no effect catalogue contains. It repeats identically in every record."""

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.signal import lfilter

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind_second.effects import MOTION, AddedEffect
from rotemina.sim.blind_second.machine_axis import FineTimeGrid, SecondAxis

# Knots of the surface in each direction.
_KNOT_COUNT = 24


def draw_remainder(axis: SecondAxis, rng: np.random.Generator) -> AddedEffect:
    """Draw a random smooth surface over position and filtered speed.

    The recent mean speed scales it up.
    """
    knots = gaussian_filter1d(
        gaussian_filter1d(rng.normal(size=(_KNOT_COUNT, _KNOT_COUNT)), 1.5, 0), 2.5, 1
    )
    speed_smoothing_s, recent_s = rng.uniform(0.02, 0.1), rng.uniform(0.5, 2.0)
    speed_scale, recent_gain = axis.travel * rng.uniform(2.0, 6.0), rng.uniform(0.0, 1.0)

    def act(
        values: FloatArray,
        motion: FloatArray,
        grid: FineTimeGrid,
        _record_rng: np.random.Generator,
        size: float,
    ) -> FloatArray:
        position = motion[:, axis.index]
        speed = gaussian_filter1d(
            np.gradient(position, grid.step_s), speed_smoothing_s / grid.step_s
        )
        decay = float(np.exp(-grid.step_s / recent_s))
        recent_speed = lfilter([1.0 - decay], [1.0, -decay], np.abs(speed))
        row = np.clip((position - axis.low) / axis.travel, 0.0, 1.0) * (_KNOT_COUNT - 1)
        column = (0.5 + 0.5 * np.tanh(speed / speed_scale)) * (_KNOT_COUNT - 1)
        surface = _interpolate_surface(knots, row, column) * (
            1.0 + recent_gain * np.tanh(recent_speed / speed_scale)
        )
        return np.asarray(values + size * surface)

    return AddedEffect("remainder", axis, MOTION, act, axis.floor)


def _interpolate_surface(knots: FloatArray, row: FloatArray, column: FloatArray) -> FloatArray:
    i, j = (
        np.minimum(row.astype(int), _KNOT_COUNT - 2),
        np.minimum(column.astype(int), _KNOT_COUNT - 2),
    )
    u, v = row - i, column - j
    low = knots[i, j] * (1.0 - v) + knots[i, j + 1] * v
    high = knots[i + 1, j] * (1.0 - v) + knots[i + 1, j + 1] * v
    return np.asarray(low * (1.0 - u) + high * u)
