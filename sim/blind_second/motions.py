"""Motions of the cases: sums of sines, steps with holds, and triangles of growing amplitude."""

from math import pi

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind_second.machine import SecondMotion
from rotemina.sim.robot import Robot

# A stepper works in a window of this length.
_STEPPER_WINDOW_M = 4e-3


def draw_motions(
    robot: Robot, names: tuple[str, ...], rng: np.random.Generator
) -> list[SecondMotion]:
    """Draw three training motions of all axes, and a fourth one that is held out."""
    draw_functions = [_draw_sines, _draw_steps, _draw_triangles, _draw_sines]
    windows = [_draw_window(robot, name, rng) for name in names]
    motions = []
    for draw_function in draw_functions:
        rate_hz = float(rng.choice([500.0, 1000.0]))
        time_s = np.arange(int(rng.uniform(6.0, 10.0) * rate_hz)) / rate_hz
        shares = [draw_function(time_s, rng) for _ in names]
        values = [low + (high - low) * x for (low, high), x in zip(windows, shares, strict=True)]
        motions.append(SecondMotion(1.0 / rate_hz, np.column_stack(values)))
    return motions


def _draw_window(robot: Robot, name: str, rng: np.random.Generator) -> tuple[float, float]:
    axis = robot.axes[name]
    low, high = axis.range
    if axis.kind == "stepper":
        low += rng.uniform(0.2, 0.7) * (high - low)
        return low, low + _STEPPER_WINDOW_M
    return low + 0.05 * (high - low), high - 0.05 * (high - low)


def _draw_sines(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    tones = np.zeros(len(time_s))
    for frequency_hz in np.exp(rng.uniform(np.log(0.2), np.log(12.0), 9)):
        tones += np.sin(2.0 * pi * frequency_hz * time_s + rng.uniform(0.0, 2.0 * pi)) / (
            1.0 + frequency_hz
        )
    amplitude = rng.uniform(0.25, 0.42) / np.abs(tones).max()
    return np.asarray(0.5 + amplitude * tones * np.minimum(time_s / 0.5, 1.0))


def _draw_steps(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    step_count = int(rng.integers(5, 9))
    levels = np.concatenate([[0.5], rng.uniform(0.08, 0.92, step_count)])
    step_index = np.minimum((time_s / time_s[-1] * (step_count + 1)).astype(int), step_count)
    return np.asarray(levels[step_index])


def _draw_triangles(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    cycles = rng.uniform(0.5, 1.2) * time_s
    amplitude = rng.uniform(0.05, 0.15) + rng.uniform(0.2, 0.3) * time_s / time_s[-1]
    return np.asarray(0.5 + amplitude * 2.0 / pi * np.arcsin(np.sin(2.0 * pi * cycles)))
