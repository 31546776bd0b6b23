"""Motions of the cases: sums of sines that fade, steps with holds, triangles of many sizes."""

from math import pi

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind_second.machine import Motion
from rotemina.sim.robot.model import Robot

_WINDOW_M = 4e-3  # in which a stepper works


def motions(robot: Robot, names: tuple[str, ...], rng: np.random.Generator) -> list[Motion]:
    """Return three motions of all axes for training, and one to be held back."""
    makers = [_sines, _steps, _triangles, _sines]
    ends = [_window(robot, name, rng) for name in names]
    made = []
    for maker in makers:
        rate_hz = float(rng.choice([500.0, 1000.0]))
        time_s = np.arange(int(rng.uniform(6.0, 10.0) * rate_hz)) / rate_hz
        shares = [maker(time_s, rng) for _ in names]
        values = [low + (high - low) * x for (low, high), x in zip(ends, shares, strict=True)]
        made.append(Motion(1.0 / rate_hz, np.column_stack(values)))
    return made


def _window(robot: Robot, name: str, rng: np.random.Generator) -> tuple[float, float]:
    axis = robot.axes[name]
    low, high = axis.range
    if axis.kind == "stepper":
        low += rng.uniform(0.2, 0.7) * (high - low)
        return low, low + _WINDOW_M
    return low + 0.05 * (high - low), high - 0.05 * (high - low)


def _sines(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    tones = np.zeros(len(time_s))
    for hertz in np.exp(rng.uniform(np.log(0.2), np.log(12.0), 9)):
        tones += np.sin(2.0 * pi * hertz * time_s + rng.uniform(0.0, 2.0 * pi)) / (1.0 + hertz)
    size = rng.uniform(0.25, 0.42) / np.abs(tones).max()
    return np.asarray(0.5 + size * tones * np.minimum(time_s / 0.5, 1.0))


def _steps(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    number = int(rng.integers(5, 9))
    levels = np.concatenate([[0.5], rng.uniform(0.08, 0.92, number)])
    at = np.minimum((time_s / time_s[-1] * (number + 1)).astype(int), number)
    return np.asarray(levels[at])


def _triangles(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    turn = rng.uniform(0.5, 1.2) * time_s
    size = rng.uniform(0.05, 0.15) + rng.uniform(0.2, 0.3) * time_s / time_s[-1]
    return np.asarray(0.5 + size * 2.0 / pi * np.arcsin(np.sin(2.0 * pi * turn)))
