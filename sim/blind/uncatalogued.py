"""Effects that no catalogue contains, so that *unknown* is the correct answer.

Each function draws the shape of an effect at random. Its docstring says what the size measures.
"""

from math import pi

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind import mechanics
from rotemina.sim.blind.filters import apply_low_pass, compute_mode_poles, delay_signal
from rotemina.sim.blind.loads import make_load_row
from rotemina.sim.blind.part import BlindAxis, EffectPart, SignalStage, SimulationRun


def draw_speed_history_gain(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw a gain that depends on the recent speed of the axis.

    The size is the relative change.
    """
    memory_s = rng.uniform(0.3, 1.5)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        speed = np.abs(np.gradient(_smooth(values, run)))
        recent_speed = apply_low_pass(speed, np.array([-1.0 / memory_s]), run.step_s)
        middle = axis.start + 0.5 * axis.travel
        return np.asarray(
            values + size * (values - middle) * recent_speed / (recent_speed.std() + 1e-30)
        )

    return EffectPart("unknown", axis, SignalStage.ACTUATOR, act, (1e-4, 0.1))


def _smooth(values: FloatArray, run: SimulationRun) -> FloatArray:
    return apply_low_pass(run.hold_before_record(values), compute_mode_poles(40.0, 0.8), run.step_s)


def draw_breathing_stiffness(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw a stiffness that varies sinusoidally with time.

    The size is the relative change.
    """
    rate, phase = 2.0 * pi * rng.uniform(0.15, 2.5), rng.uniform(0.0, 2.0 * pi)
    # Most records of a stepper are small moves, so the rest position must lie within them.
    rest_bounds = (0.0, 0.03) if axis.kind == "stepper" else (0.3, 0.7)
    rest_position = axis.start + rng.uniform(*rest_bounds) * axis.travel

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        return make_load_row(
            mechanics.BREATHING, axis, [size * axis.stiffness, rate, phase, rest_position]
        )

    return EffectPart("unknown", axis, SignalStage.LOAD, act, (1e-5, 0.3))


def draw_quadratic_mode(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw a slow mode that the square of the command drives.

    The size is its amplitude, as a fraction of the travel.
    """
    poles = compute_mode_poles(rng.uniform(0.4, 3.0), rng.uniform(0.05, 0.4))
    centre = rng.uniform(0.4, 0.6)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        x = (run.hold_before_record(values) - axis.start) / axis.travel - centre
        curve = 4.0 * x**2
        swing = apply_low_pass(curve, poles, run.step_s) - curve
        return np.asarray(values + size * axis.travel * swing)

    return EffectPart("unknown", axis, SignalStage.ACTUATOR, act, (1e-5, 0.1))


def draw_wandering_detents(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw magnetic detents whose positions depend on time and past motion.

    The size is their amplitude, m or rad.
    """
    period = axis.travel * rng.uniform(0.02, 0.12)
    drift_hz, memory_s = rng.uniform(0.1, 0.6), rng.uniform(0.3, 2.0)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        time_s = np.arange(len(values)) * run.step_s
        past_position = apply_low_pass(
            run.hold_before_record(values), np.array([-1.0 / memory_s]), run.step_s
        )
        cycles = (values - 0.7 * past_position) / period + drift_hz * time_s
        return np.asarray(values + size * np.sin(2.0 * pi * cycles))

    return EffectPart("unknown", axis, SignalStage.ACTUATOR, act, (axis.floor, 0.03 * axis.span))


def draw_busy_delay(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw a delay that occurs while a program is busy, which happens periodically.

    The size is in seconds.
    """
    period_s, duty = rng.uniform(0.7, 2.5), rng.uniform(0.3, 0.6)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        x = (values - axis.start) / axis.travel
        time_s = np.arange(len(values)) * run.step_s
        is_busy = ((time_s / period_s) % 1.0 < duty) * 1.0
        load = apply_low_pass(is_busy * (0.3 + np.abs(x)), np.array([-20.0]), run.step_s)
        return delay_signal(values, size / run.step_s * load)

    return EffectPart("unknown", axis, SignalStage.DRIVE, act, (2e-4, 3e-2))


def draw_directional_relaxation(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw a slow relaxation whose rate depends on the direction of motion.

    The size is the fraction of the motion that lags.
    """
    up_s, down_s = rng.uniform(0.1, 0.4), rng.uniform(0.8, 3.0)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        position = run.hold_before_record(values)
        lag = position - _relax_by_direction(position, run.step_s / up_s, run.step_s / down_s)
        return values - size * lag

    return EffectPart("unknown", axis, SignalStage.ACTUATOR, act, (1e-5, 0.1))


@numba.njit(cache=True, error_model="numpy")
def _relax_by_direction(values: FloatArray, up_ratio: float, down_ratio: float) -> FloatArray:
    out = np.empty_like(values)
    state = values[0]
    for k in range(len(values)):
        state += (values[k] - state) * (up_ratio if values[k] > state else down_ratio)
        out[k] = state
    return out


def draw_axis_product(
    axis: BlindAxis, rng: np.random.Generator, others: tuple[BlindAxis, ...]
) -> EffectPart:
    """Draw a motion that follows products of the past motion of this axis and of others.

    The size is in m or rad.
    """
    first, second = others[0], others[-1]
    memory_s = rng.uniform(0.1, 1.0)

    def act(motion: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        motion = run.hold_before_record(motion)
        x = (motion[:, first.index] - first.start) / first.travel - 0.5
        y = (motion[:, axis.index] - axis.start) / axis.travel - 0.5
        z = (motion[:, second.index] - second.start) / second.travel - 0.5
        out = 4.0 * apply_low_pass(x, np.array([-1.0 / memory_s]), run.step_s) * y
        out = out + 4.0 * z * apply_low_pass(y, np.array([-1.0 / memory_s]), run.step_s)
        return np.asarray(size * (out - out[run.lead]))

    return EffectPart("unknown", axis, SignalStage.MOTION, act, (axis.floor, 0.05 * axis.span))
