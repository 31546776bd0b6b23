"""A remainder outside every catalogue, the same in every run."""

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.signal import lfilter

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind_second.effects import MOTION, Added
from rotemina.sim.blind_second.machine_axis import AxisFacts, Grid


def draw_remainder(axis: AxisFacts, rng: np.random.Generator) -> Added:
    """Draw a smooth surface over place and filtered speed that recent activity swells."""
    knots = gaussian_filter1d(gaussian_filter1d(rng.normal(size=(24, 24)), 1.5, 0), 2.5, 1)
    speed_s, active_s = rng.uniform(0.02, 0.1), rng.uniform(0.5, 2.0)
    pace, swell = axis.way * rng.uniform(2.0, 6.0), rng.uniform(0.0, 1.0)

    def act(x: FloatArray, q: FloatArray, g: Grid, c: np.random.Generator, s: float) -> FloatArray:
        own = q[:, axis.index]
        speed = gaussian_filter1d(np.gradient(own, g.step_s), speed_s / g.step_s)
        keep = float(np.exp(-g.step_s / active_s))
        active = lfilter([1.0 - keep], [1.0, -keep], np.abs(speed))
        place = np.clip((own - axis.low) / axis.way, 0.0, 1.0) * 23.0
        fast = (0.5 + 0.5 * np.tanh(speed / pace)) * 23.0
        made = _surface(knots, place, fast) * (1.0 + swell * np.tanh(active / pace))
        return np.asarray(x + s * made)

    return Added("remainder", axis, MOTION, act, axis.floor)


def _surface(knots: FloatArray, row: FloatArray, column: FloatArray) -> FloatArray:
    """Interpolate between knots in both directions."""
    i, j = np.minimum(row.astype(int), 22), np.minimum(column.astype(int), 22)
    u, v = row - i, column - j
    low = knots[i, j] * (1.0 - v) + knots[i, j + 1] * v
    high = knots[i + 1, j] * (1.0 - v) + knots[i + 1, j + 1] * v
    return np.asarray(low * (1.0 - u) + high * u)
