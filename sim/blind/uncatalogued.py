"""Effects that are in no catalogue: the right answer to them is *unknown*."""

from math import pi

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind import mechanics
from rotemina.sim.blind.filters import lagged, mode_poles, shifted
from rotemina.sim.blind.loads import row
from rotemina.sim.blind.part import Axis, Part, SimulationRun, Stage


def speed_history_gain(axis: Axis, rng: np.random.Generator) -> Part:
    """Gain that depends on how fast the axis moved lately; size is the share."""
    memory_s = rng.uniform(0.3, 1.5)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        speed = np.abs(np.gradient(_smoothed(values, run)))
        recent = lagged(speed, np.array([-1.0 / memory_s]), run.step_s)
        middle = axis.start + 0.5 * axis.travel
        return np.asarray(values + size * (values - middle) * recent / (recent.std() + 1e-30))

    return Part("unknown", axis, Stage.ACTUATOR, act, (1e-4, 0.1))


def _smoothed(values: FloatArray, run: SimulationRun) -> FloatArray:
    return lagged(run.settled(values), mode_poles(40.0, 0.8), run.step_s)


def breathing_stiffness(axis: Axis, rng: np.random.Generator) -> Part:
    """Stiffness that rises and falls with time by itself; size is the share."""
    rate, phase = 2.0 * pi * rng.uniform(0.15, 2.5), rng.uniform(0.0, 2.0 * pi)
    # Within the small moves that most records of a stepper are.
    within = (0.0, 0.03) if axis.kind == "stepper" else (0.3, 0.7)
    rest = axis.start + rng.uniform(*within) * axis.travel

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        return row(mechanics.BREATHING, axis, [size * axis.stiffness, rate, phase, rest])

    return Part("unknown", axis, Stage.LOAD, act, (1e-5, 0.3))


def quadratic_mode(axis: Axis, rng: np.random.Generator) -> Part:
    """Slow mode driven by the square of the command; size is its share of the travel."""
    poles = mode_poles(rng.uniform(0.4, 3.0), rng.uniform(0.05, 0.4))
    at = rng.uniform(0.4, 0.6)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        x = (run.settled(values) - axis.start) / axis.travel - at
        curve = 4.0 * x**2
        swing = lagged(curve, poles, run.step_s) - curve
        return np.asarray(values + size * axis.travel * swing)

    return Part("unknown", axis, Stage.ACTUATOR, act, (1e-5, 0.1))


def wandering_detents(axis: Axis, rng: np.random.Generator) -> Part:
    """Magnetic detents whose places move with time and past motion; size in m or rad."""
    period = axis.travel * rng.uniform(0.02, 0.12)
    drift_hz, memory_s = rng.uniform(0.1, 0.6), rng.uniform(0.3, 2.0)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        time_s = np.arange(len(values)) * run.step_s
        past = lagged(run.settled(values), np.array([-1.0 / memory_s]), run.step_s)
        turn = (values - 0.7 * past) / period + drift_hz * time_s
        return np.asarray(values + size * np.sin(2.0 * pi * turn))

    return Part("unknown", axis, Stage.ACTUATOR, act, (axis.floor, 0.03 * axis.span))


def busy_delay(axis: Axis, rng: np.random.Generator) -> Part:
    """Delay that grows while the other end of the program is busy; size in seconds."""
    period_s, duty = rng.uniform(0.7, 2.5), rng.uniform(0.3, 0.6)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        x = (values - axis.start) / axis.travel
        time_s = np.arange(len(values)) * run.step_s
        busy = ((time_s / period_s) % 1.0 < duty) * 1.0
        late = lagged(busy * (0.3 + np.abs(x)), np.array([-20.0]), run.step_s)
        return shifted(values, size / run.step_s * late)

    return Part("unknown", axis, Stage.DRIVE, act, (2e-4, 3e-2))


def weary_damping(axis: Axis, rng: np.random.Generator) -> Part:
    """Slow relaxation whose rate depends on the direction of past motion; size is its share."""
    up, down = rng.uniform(0.1, 0.4), rng.uniform(0.8, 3.0)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        start = run.settled(values)
        late = start - _limping(start, run.step_s / up, run.step_s / down)
        return values - size * late

    return Part("unknown", axis, Stage.ACTUATOR, act, (1e-5, 0.1))


@numba.njit(cache=True, error_model="numpy")
def _limping(values: FloatArray, up: float, down: float) -> FloatArray:
    out = np.empty_like(values)
    state = values[0]
    for k in range(len(values)):
        state += (values[k] - state) * (up if values[k] > state else down)
        out[k] = state
    return out


def product_of_axes(axis: Axis, rng: np.random.Generator, others: tuple[Axis, ...]) -> Part:
    """Leak of the product of two axes' past motion; size in m or rad."""
    first, second = others[0], others[-1]
    memory_s = rng.uniform(0.1, 1.0)

    def act(motion: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        motion = run.settled(motion)
        x = (motion[:, first.index] - first.start) / first.travel - 0.5
        y = (motion[:, axis.index] - axis.start) / axis.travel - 0.5
        z = (motion[:, second.index] - second.start) / second.travel - 0.5
        out = 4.0 * lagged(x, np.array([-1.0 / memory_s]), run.step_s) * y
        out = out + 4.0 * z * lagged(y, np.array([-1.0 / memory_s]), run.step_s)
        return np.asarray(size * (out - out[run.lead]))

    return Part("unknown", axis, Stage.MOTION, act, (axis.floor, 0.05 * axis.span))
