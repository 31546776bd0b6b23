"""Motion added to an axis: coupling from another one, thermal drift, vibration."""

from math import pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind.filters import lagged, mode_poles
from rotemina.sim.blind.part import Axis, Part, SimulationRun, Stage


def cross_coupling(axis: Axis, rng: np.random.Generator, other: Axis) -> Part:
    """Another axis' motion leaks in, at once or through a mode; size is k in spans."""
    sign = rng.choice([-1.0, 1.0]) * axis.span / other.span
    through = rng.uniform() < 0.3
    poles = mode_poles(rng.uniform(15.0, 120.0), rng.uniform(0.02, 0.3))

    def act(motion: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        leaking = motion[:, other.index] - motion[run.lead, other.index]
        if through:
            leaking = lagged(leaking, poles, run.step_s)
        return np.asarray(sign * size * leaking)

    sizes = (1e-5, 1.5)
    return Part("cross_coupling", axis, Stage.MOTION, act, sizes, from_axis=other.name)


def thermal_drift(axis: Axis, rng: np.random.Generator) -> Part:
    """Warm-up with a quick and a slow time constant; size in m or rad."""
    quick, slow = rng.uniform(1.5, 6.0), rng.uniform(15.0, 90.0)
    share = rng.uniform(0.15, 0.7)
    sign = rng.choice([-1.0, 1.0])

    def act(motion: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        warm_s = np.maximum(np.arange(len(motion)) - run.lead, 0) * run.step_s
        rise = share * np.expm1(-warm_s / quick) + (1.0 - share) * np.expm1(-warm_s / slow)
        return np.asarray(-sign * size * rise)

    return Part("thermal_drift", axis, Stage.MOTION, act, (axis.floor, 0.05 * axis.span))


def vibration(axis: Axis, rng: np.random.Generator) -> Part:
    """One to three lines whose amplitude and phase wander slowly; size is the first, m or rad."""
    seed = int(rng.integers(2**31))
    swelling, turning = rng.uniform(0.0, 0.15), rng.uniform(0.0, 0.3)
    frequencies = np.exp(rng.uniform(np.log(6.0), np.log(120.0), rng.choice([1, 1, 2, 3])))

    def act(motion: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        draw = run.chance(seed)
        time_s = np.arange(len(motion)) * run.step_s
        total = np.zeros(len(motion))
        for order, frequency in enumerate(frequencies):
            phase = draw.uniform(0.0, 2.0 * pi) + turning * _wander(time_s, draw)
            swell = 1.0 + swelling * _wander(time_s, draw)
            total += swell / (1 + order) * np.sin(2.0 * pi * frequency * time_s + phase)
        return np.asarray(size * total)

    return Part("vibration", axis, Stage.MOTION, act, (0.5 * axis.floor, 0.02 * axis.span))


def _wander(time_s: NDArray[np.floating[Any]], draw: np.random.Generator) -> FloatArray:
    """Return a smooth random curve (n,) of rms about 1, that changes over several seconds."""
    knots_s = np.arange(-3.0, time_s[-1] + 9.0, 3.0)
    return np.asarray(np.interp(time_s, knots_s, draw.normal(size=len(knots_s))))
