"""A remainder that no catalogue names: small, smooth and the same in every run."""

from math import pi

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind.filters import lagged
from rotemina.sim.blind.part import Axis, Part, SimulationRun, Stage

REMAINDER = "remainder"
LEAST_SHARE, MOST_SHARE = 0.05, 0.3  # of the gap's rms
_WAVES = 16


def draw_remainder(axis: Axis, rng: np.random.Generator) -> Part:
    """Draw the shape of a remainder on an axis; its size is in m or rad."""
    return _of_motion(axis, rng) if rng.uniform() < 0.6 else _of_time(axis, rng)


def _of_motion(axis: Axis, rng: np.random.Generator) -> Part:
    """Draw a smooth random function of place, filtered speed and recent activity."""
    speed_s, active_s = rng.uniform(0.01, 0.1), rng.uniform(0.3, 2.0)
    pace = axis.travel / rng.uniform(0.1, 0.4)
    waves = rng.normal(0.0, (4.0, 1.5, 1.0), (_WAVES, 3))
    phases = rng.uniform(0.0, 2.0 * pi, _WAVES)

    def act(motion: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        own = run.settled(motion[:, axis.index])
        slow = lagged(np.gradient(own, run.step_s), np.array([-1.0 / speed_s]), run.step_s)
        active = lagged(np.abs(slow), np.array([-1.0 / active_s]), run.step_s)
        seen = ((own - axis.start) / axis.travel, slow / pace, active / pace)
        made = np.zeros(len(own))
        for (place, speed, recent), phase in zip(waves, phases, strict=True):
            made += np.cos(place * seen[0] + speed * seen[1] + recent * seen[2] + phase)
        return np.asarray(size * made)

    return Part(REMAINDER, axis, Stage.MOTION, act, (0.0, np.inf))


def _of_time(axis: Axis, rng: np.random.Generator) -> Part:
    """Draw a coloured force, slow beside the axis' own period: it moves it by force/stiffness."""
    colour = np.array([-2.0 * pi * rng.uniform(0.3, 6.0), -2.0 * pi * rng.uniform(6.0, 20.0)])
    own_seed = int(rng.integers(2**31))

    def act(motion: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        # The same in every run, whatever its rate: white on a grid of its own, then between.
        grid_s = 0.01
        time_s = np.arange(len(motion)) * run.step_s
        number = int(time_s[-1] / grid_s) + 2
        white = np.random.default_rng(own_seed).normal(0.0, 1.0, number)
        coloured = lagged(white, colour, grid_s)
        return np.asarray(size * np.interp(time_s, np.arange(number) * grid_s, coloured))

    return Part(REMAINDER, axis, Stage.MOTION, act, (0.0, np.inf))
