"""Static curves: bows and bends of a characteristic by sine, exponential and tanh."""

from collections.abc import Callable
from math import pi

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind.part import Axis

Curve = Callable[[FloatArray], FloatArray]


def draw_curve(axis: Axis, rng: np.random.Generator) -> Curve:
    """Draw a curve over the travel of the case, of the order of 1, that is no straight line."""
    form = rng.integers(4)
    rate = rng.uniform(1.5, 3.5) * rng.choice([-1.0, 1.0])
    at, turns = rng.uniform(0.35, 0.65), rng.uniform(0.7, 1.0)

    def curve(position: FloatArray) -> FloatArray:
        x = (position - axis.start) / axis.travel
        if form == 0:
            return np.asarray(np.sin(pi * x))
        if form == 1:
            return np.asarray(np.expm1(rate * np.clip(x, -1.0, 2.0)) / np.expm1(rate) - x) * 3.0
        if form == 2:
            return np.asarray(np.tanh(abs(rate) * (x - at)) - np.tanh(abs(rate)) * (x - at))
        return np.asarray(np.sin(2.0 * pi * (x - at) * turns) / 1.5)

    return curve
