"""Commands of the cases: decaying waves, noise on slow sines, holds, staircases and ramps."""

from collections.abc import Callable, Mapping, Sequence
from math import pi
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind.filters import apply_low_pass
from rotemina.sim.blind.machine import SampledCommands
from rotemina.sim.robot import Robot

# A shape maps times (n,) to levels (n,): fractions of the range of a piezo, or of the working
# window of a stepper.
MotionShape = Callable[[FloatArray, np.random.Generator], FloatArray]


class ExcitationPlan(NamedTuple):
    """Bounds of the record length, the sample rates to choose from, and the shape of the motion."""

    length_s: tuple[float, float]
    rates_hz: tuple[float, ...]
    shape: MotionShape


def _compute_triangle_wave(cycles: FloatArray) -> FloatArray:
    return 2.0 / pi * np.arcsin(np.sin(2.0 * pi * cycles))


def _draw_decaying_wave(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    cycles = rng.uniform(0.6, 1.5) * time_s
    wave = _compute_triangle_wave(cycles) if rng.uniform() < 0.6 else np.sin(2.0 * pi * cycles)
    envelope = 1.0 - rng.uniform(0.6, 0.9) * time_s / time_s[-1]
    onset = np.minimum(time_s / 0.4, 1.0)
    onset = onset * onset * (3.0 - 2.0 * onset)
    return np.asarray(
        0.5 + rng.choice([-1.0, 1.0]) * rng.uniform(0.3, 0.4) * envelope * onset * wave
    )


def _draw_noisy_sine(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    slow_sine = np.sin(2.0 * pi * rng.uniform(0.35, 0.7) * time_s + rng.uniform(-2.0, 2.0))
    return (
        0.5
        + rng.uniform(0.1, 0.2) * slow_sine
        + rng.uniform(0.002, 0.008) * _draw_multisine(time_s, rng)
    )


def _draw_multisine(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Draw a multisine of rms 1 with random phases, from 2 Hz to about 0.4 of the rate."""
    rate_hz = (len(time_s) - 1) / time_s[-1]
    n = len(time_s)
    frequency_hz = np.fft.rfftfreq(n, 1.0 / rate_hz)
    is_in_band = (frequency_hz > 2.0) & (frequency_hz < rng.uniform(0.35, 0.45) * rate_hz)
    tones = np.fft.irfft(is_in_band * np.exp(1j * rng.uniform(0.0, 2.0 * pi, len(frequency_hz))), n)
    return np.asarray(tones / tones.std())


def _draw_held_steps(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    step_count = int(rng.integers(2, 5))
    weights = rng.uniform(0.4, 1.6, step_count)
    step_times_s = 1.0 + np.cumsum(np.concatenate([[0.0], weights / weights.sum()])) * (
        time_s[-1] - 1.0
    )
    levels = [rng.uniform(0.15, 0.85)]
    for _ in range(step_count):
        jump = rng.uniform(0.2, 0.55) * (-1.0 if levels[-1] > 0.5 else 1.0)
        levels.append(float(np.clip(levels[-1] + jump, 0.04, 0.96)))
    return np.asarray(np.array(levels)[np.searchsorted(step_times_s[:-1], time_s, side="right")])


def _draw_staircase(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    step_count = int(rng.integers(14, 22))
    knots = np.cumsum([0.0, *rng.uniform(0.8, 1.2, step_count)])
    step_index = np.floor(time_s / time_s[-1] * knots[-1] * 0.999).astype(int)
    peak = int(rng.integers(5, 9))
    path = np.concatenate(
        [np.arange(peak), np.arange(peak, peak - 8, -1), np.arange(peak - 8, peak + 20)]
    )
    levels = (path - path[: step_count + 1].min()) / np.ptp(path[: step_count + 1])
    return 0.15 + 0.7 * _replace_jumps_by_ramps(
        levels[np.minimum(step_index, len(levels) - 1)], time_s
    )


def _replace_jumps_by_ramps(levels: FloatArray, time_s: FloatArray) -> FloatArray:
    width = max(round(0.03 * (len(time_s) - 1) / time_s[-1]), 1)
    padded = np.concatenate([np.full(width, levels[0]), levels])
    sums = np.cumsum(padded)
    return np.asarray((sums[width:] - sums[:-width]) / width)


def _draw_ramps(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    end_s = time_s[-1]
    outward_s, return_s = rng.uniform(0.2, 0.32) * end_s, rng.uniform(0.45, 0.55) * end_s
    knots_s = [
        0.0,
        0.5,
        0.5 + outward_s,
        1.0 + outward_s,
        1.0 + outward_s + return_s,
        end_s + 1.0,
    ]
    first = rng.choice([0.0, 1.0])
    last = abs(first - rng.uniform(0.0, 0.1))
    levels = np.array([first, first, 1.0 - first, 1.0 - first, last, last])
    return np.asarray(np.interp(time_s, knots_s, levels))


def _draw_noisy_triangle(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    envelope = 1.0 - rng.uniform(0.5, 0.85) * time_s / time_s[-1]
    wave = _compute_triangle_wave(rng.uniform(0.25, 0.55) * time_s)
    tones = rng.uniform(0.003, 0.009) * _draw_multisine(time_s, rng)
    return np.asarray(0.5 + rng.choice([-1.0, 1.0]) * 0.45 * envelope * wave + tones)


def _draw_slow_sine(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    return 0.5 + rng.uniform(0.02, 0.06) * np.sin(2.0 * pi * rng.uniform(0.4, 1.2) * time_s)


def _draw_single_step(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    step = rng.uniform(0.02, 0.08) * rng.choice([-1.0, 1.0])
    return np.asarray(0.5 + step * (time_s >= 0.3 * time_s[-1]))


PIEZO_PLANS = (
    ExcitationPlan((7.0, 9.0), (2000.0, 1000.0), _draw_decaying_wave),
    ExcitationPlan((6.0, 8.0), (2000.0, 2000.0, 1500.0), _draw_noisy_sine),
    ExcitationPlan((20.0, 30.0), (500.0, 500.0, 1000.0), _draw_held_steps),
    ExcitationPlan((8.0, 12.0), (1000.0,), _draw_staircase),
    ExcitationPlan((6.0, 9.0), (2000.0,), _draw_noisy_triangle),
)
# Plans of a stepper, each with the bounds of the length of its window (m).
STEPPER_PLANS_AND_TRAVELS = (
    (ExcitationPlan((9.0, 12.0), (1000.0, 1000.0, 500.0), _draw_staircase), (1.5e-4, 5e-4)),
    (ExcitationPlan((11.0, 14.0), (1000.0, 1000.0, 2000.0), _draw_ramps), (3e-3, 6e-3)),
    (ExcitationPlan((9.0, 11.0), (1000.0, 1000.0, 2000.0), _draw_noisy_triangle), (1e-4, 1.5e-4)),
)
POOR_PLANS = (
    ExcitationPlan((6.0, 10.0), (1000.0,), _draw_slow_sine),
    ExcitationPlan((6.0, 8.0), (1000.0,), _draw_single_step),
)


def _draw_window_start(robot: Robot, name: str, rng: np.random.Generator) -> float:
    axis = robot.axes[name]
    return axis.range[0] + rng.uniform(0.35, 0.6) * axis.span


def draw_training(
    robot: Robot, names: Sequence[str], rng: np.random.Generator
) -> list[SampledCommands]:
    """Draw three records with different excitation; all axes have the same kind."""
    if robot.axes[names[0]].kind == "piezo":
        plans = [PIEZO_PLANS[0], PIEZO_PLANS[1], PIEZO_PLANS[2]]
        if rng.uniform() < 0.4:
            plans[rng.integers(0, 2)] = PIEZO_PLANS[rng.choice([3, 4])]
        return [
            _draw_commands(robot, names, plan, _get_ranges(robot, names), rng) for plan in plans
        ]
    window_starts = {name: _draw_window_start(robot, name, rng) for name in names}
    return [
        _draw_commands(robot, names, plan, _draw_windows(window_starts, travel, rng), rng)
        for plan, travel in STEPPER_PLANS_AND_TRAVELS
    ]


def draw_poor_training(
    robot: Robot, names: Sequence[str], rng: np.random.Generator, *, step: bool
) -> list[SampledCommands]:
    """Draw one record of poor excitation: a small slow sine or a single step."""
    windows = _get_ranges(robot, names)
    if robot.axes[names[0]].kind == "stepper":
        window_starts = {name: _draw_window_start(robot, name, rng) for name in names}
        windows = _draw_windows(window_starts, (4e-4, 1.5e-3), rng)
    return [_draw_commands(robot, names, POOR_PLANS[int(step)], windows, rng)]


def _get_ranges(robot: Robot, names: Sequence[str]) -> dict[str, tuple[float, float]]:
    """Return the start and length of the range of each axis."""
    return {name: (robot.axes[name].range[0], robot.axes[name].span) for name in names}


def _draw_windows(
    starts: Mapping[str, float], travel: tuple[float, float], rng: np.random.Generator
) -> dict[str, tuple[float, float]]:
    """Return the start and length of the working window of each axis."""
    return {name: (start, rng.uniform(*travel)) for name, start in starts.items()}


def _draw_commands(
    robot: Robot,
    names: Sequence[str],
    plan: ExcitationPlan,
    windows: Mapping[str, tuple[float, float]],
    rng: np.random.Generator,
) -> SampledCommands:
    rate_hz = float(rng.choice(plan.rates_hz))
    time_s = np.arange(round(rng.uniform(*plan.length_s) * rate_hz)) / rate_hz
    columns = [windows[n][0] + windows[n][1] * plan.shape(time_s, rng) for n in names]
    return SampledCommands(1.0 / rate_hz, np.column_stack(columns))


def draw_held_out(
    robot: Robot, names: Sequence[str], travels: Mapping[str, FloatArray], rng: np.random.Generator
) -> SampledCommands:
    """Draw the held-out record, which no fit uses: steps, sines and slow moves.

    The first second moves the axes over their travel. The record stays within the
    travel of the training records.
    """
    rate_hz = 2000.0 if robot.axes[names[0]].kind == "piezo" else 1000.0
    time_s = np.arange(round((10.0 if rate_hz > 1500.0 else 12.0) * rate_hz)) / rate_hz
    columns = []
    for name in names:
        low, high = travels[name]
        level = _draw_mixed_motion(time_s, rng)
        # The speed and acceleration of a stepper are limited.
        if robot.axes[name].kind == "stepper":
            level = apply_low_pass(level, np.array([-8.0, -8.0, -8.0]), 1.0 / rate_hz)
        tones = 0.003 * _draw_multisine(time_s, rng) * (time_s > time_s[-1] - 2.5)
        columns.append(low + (high - low) * (level + tones))
    return SampledCommands(1.0 / rate_hz, np.column_stack(columns))


def _draw_mixed_motion(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    start = rng.uniform(0.2, 0.8)
    knots_s, levels = [0.0, 0.1, 0.3, 0.55, 0.8, 0.9], [start, start, 0.97, 0.03, start, start]
    level = np.interp(time_s, knots_s, levels)
    is_after_first_second = time_s > 1.0
    jumps_s = np.sort(rng.uniform(1.2, time_s[-1] - 0.5, 6))
    held_levels = np.concatenate([[start], rng.uniform(0.1, 0.9, 6)])
    level[is_after_first_second] = _replace_jumps_by_ramps(
        held_levels[np.searchsorted(jumps_s, time_s)], time_s
    )[is_after_first_second]
    is_swinging = is_after_first_second & (time_s > rng.uniform(2.0, 6.0))
    clearance = np.minimum(level, 1.0 - level)
    level[is_swinging] += (
        0.8 * np.minimum(clearance, 0.15) * np.sin(2.0 * pi * rng.uniform(1.5, 4.0) * time_s)
    )[is_swinging]
    return np.asarray(level)
