"""Commands of the cases: swings, noise on slow sines, holds, staircases, ramps."""

from collections.abc import Callable, Mapping, Sequence
from math import pi
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind.filters import lagged
from rotemina.sim.blind.machine import Commands
from rotemina.sim.robot.model import Robot

# Shapes are shares: of the range for a piezo, of the window it works in for a stepper.
Shape = Callable[[FloatArray, np.random.Generator], FloatArray]


class Plan(NamedTuple):
    """Length, rates to choose from and how each axis moves."""

    length_s: tuple[float, float]
    rates_hz: tuple[float, ...]
    shape: Shape


def _triangle(turn: FloatArray) -> FloatArray:
    return 2.0 / pi * np.arcsin(np.sin(2.0 * pi * turn))


def _decaying(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    turn = rng.uniform(0.6, 1.5) * time_s
    wave = _triangle(turn) if rng.uniform() < 0.6 else np.sin(2.0 * pi * turn)
    fading = 1.0 - rng.uniform(0.6, 0.9) * time_s / time_s[-1]
    onset = np.minimum(time_s / 0.4, 1.0)
    onset = onset * onset * (3.0 - 2.0 * onset)
    return np.asarray(0.5 + rng.choice([-1.0, 1.0]) * rng.uniform(0.3, 0.4) * fading * onset * wave)


def _noisy_sine(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    slow = np.sin(2.0 * pi * rng.uniform(0.35, 0.7) * time_s + rng.uniform(-2.0, 2.0))
    return 0.5 + rng.uniform(0.1, 0.2) * slow + rng.uniform(0.002, 0.008) * _tones(time_s, rng)


def _tones(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Multisine of rms 1 and random phases, from 2 Hz up to half of half the rate."""
    rate_hz = (len(time_s) - 1) / time_s[-1]
    n = len(time_s)
    hertz = np.fft.rfftfreq(n, 1.0 / rate_hz)
    band = (hertz > 2.0) & (hertz < rng.uniform(0.35, 0.45) * rate_hz)
    tones = np.fft.irfft(band * np.exp(1j * rng.uniform(0.0, 2.0 * pi, len(hertz))), n)
    return np.asarray(tones / tones.std())


def _held_steps(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    number = int(rng.integers(2, 5))
    weights = rng.uniform(0.4, 1.6, number)
    at = 1.0 + np.cumsum(np.concatenate([[0.0], weights / weights.sum()])) * (time_s[-1] - 1.0)
    levels = [rng.uniform(0.15, 0.85)]
    for _ in range(number):
        away = rng.uniform(0.2, 0.55) * (-1.0 if levels[-1] > 0.5 else 1.0)
        levels.append(float(np.clip(levels[-1] + away, 0.04, 0.96)))
    return np.asarray(np.array(levels)[np.searchsorted(at[:-1], time_s, side="right")])


def _staircase(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    number = int(rng.integers(14, 22))
    knots = np.cumsum([0.0, *rng.uniform(0.8, 1.2, number)])
    stair = np.floor(time_s / time_s[-1] * knots[-1] * 0.999).astype(int)
    up = int(rng.integers(5, 9))
    path = np.concatenate([np.arange(up), np.arange(up, up - 8, -1), np.arange(up - 8, up + 20)])
    levels = (path - path[: number + 1].min()) / np.ptp(path[: number + 1])
    return 0.15 + 0.7 * _softly(levels[np.minimum(stair, len(levels) - 1)], time_s)


def _softly(levels: FloatArray, time_s: FloatArray) -> FloatArray:
    """Replace jumps by short ramps of constant speed."""
    width = max(round(0.03 * (len(time_s) - 1) / time_s[-1]), 1)
    padded = np.concatenate([np.full(width, levels[0]), levels])
    sums = np.cumsum(padded)
    return np.asarray((sums[width:] - sums[:-width]) / width)


def _ramps(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    end = time_s[-1]
    out_s, back_s = rng.uniform(0.2, 0.32) * end, rng.uniform(0.45, 0.55) * end
    knots = [0.0, 0.5, 0.5 + out_s, 1.0 + out_s, 1.0 + out_s + back_s, end + 1.0]
    far = rng.choice([0.0, 1.0])
    rest = abs(far - rng.uniform(0.0, 0.1))
    shares = np.array([far, far, 1.0 - far, 1.0 - far, rest, rest])
    return np.asarray(np.interp(time_s, knots, shares))


def _noisy_triangle(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    fading = 1.0 - rng.uniform(0.5, 0.85) * time_s / time_s[-1]
    wave = _triangle(rng.uniform(0.25, 0.55) * time_s)
    tones = rng.uniform(0.003, 0.009) * _tones(time_s, rng)
    return np.asarray(0.5 + rng.choice([-1.0, 1.0]) * 0.45 * fading * wave + tones)


def _slow_sine(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    return 0.5 + rng.uniform(0.02, 0.06) * np.sin(2.0 * pi * rng.uniform(0.4, 1.2) * time_s)


def _one_step(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    step = rng.uniform(0.02, 0.08) * rng.choice([-1.0, 1.0])
    return np.asarray(0.5 + step * (time_s >= 0.3 * time_s[-1]))


PIEZO = (
    Plan((7.0, 9.0), (2000.0, 1000.0), _decaying),
    Plan((6.0, 8.0), (2000.0, 2000.0, 1500.0), _noisy_sine),
    Plan((20.0, 30.0), (500.0, 500.0, 1000.0), _held_steps),
    Plan((8.0, 12.0), (1000.0,), _staircase),
    Plan((6.0, 9.0), (2000.0,), _noisy_triangle),
)
# A stepper's window differs from record to record: travel in m.
STEPPER = (
    (Plan((9.0, 12.0), (1000.0, 1000.0, 500.0), _staircase), (1.5e-4, 5e-4)),
    (Plan((11.0, 14.0), (1000.0, 1000.0, 2000.0), _ramps), (3e-3, 6e-3)),
    (Plan((9.0, 11.0), (1000.0, 1000.0, 2000.0), _noisy_triangle), (1e-4, 1.5e-4)),
)
POOR = (Plan((6.0, 10.0), (1000.0,), _slow_sine), Plan((6.0, 8.0), (1000.0,), _one_step))


def _window(robot: Robot, name: str, rng: np.random.Generator) -> float:
    axis = robot.axes[name]
    return axis.range[0] + rng.uniform(0.35, 0.6) * axis.span


def training(robot: Robot, names: Sequence[str], rng: np.random.Generator) -> list[Commands]:
    """Draw three records of different excitation for axes of one kind."""
    if robot.axes[names[0]].kind == "piezo":
        plans = [PIEZO[0], PIEZO[1], PIEZO[2]]
        if rng.uniform() < 0.4:
            plans[rng.integers(0, 2)] = PIEZO[rng.choice([3, 4])]
        return [_drawn(robot, names, plan, _spans(robot, names), rng) for plan in plans]
    places = {name: _window(robot, name, rng) for name in names}
    return [
        _drawn(robot, names, plan, _places(places, travel, rng), rng) for plan, travel in STEPPER
    ]


def poor_training(
    robot: Robot, names: Sequence[str], rng: np.random.Generator, *, step: bool
) -> list[Commands]:
    """Draw one or two records of the same poor kind: a small slow sine, or a single step."""
    places = _spans(robot, names)
    if robot.axes[names[0]].kind == "stepper":
        starts = {name: _window(robot, name, rng) for name in names}
        places = _places(starts, (4e-4, 1.5e-3), rng)
    return [_drawn(robot, names, POOR[int(step)], places, rng)]


def _spans(robot: Robot, names: Sequence[str]) -> dict[str, tuple[float, float]]:
    return {name: (robot.axes[name].range[0], robot.axes[name].span) for name in names}


def _places(
    starts: Mapping[str, float], travel: tuple[float, float], rng: np.random.Generator
) -> dict[str, tuple[float, float]]:
    return {name: (start, rng.uniform(*travel)) for name, start in starts.items()}


def _drawn(
    robot: Robot,
    names: Sequence[str],
    plan: Plan,
    places: Mapping[str, tuple[float, float]],
    rng: np.random.Generator,
) -> Commands:
    rate_hz = float(rng.choice(plan.rates_hz))
    time_s = np.arange(round(rng.uniform(*plan.length_s) * rate_hz)) / rate_hz
    columns = [places[n][0] + places[n][1] * plan.shape(time_s, rng) for n in names]
    return Commands(1.0 / rate_hz, np.column_stack(columns))


def held_out(
    robot: Robot, names: Sequence[str], travels: Mapping[str, FloatArray], rng: np.random.Generator
) -> Commands:
    """Draw the record that no fit sees; its first second exercises the axes.

    It stays within what the training records travelled: steps, sines and slow moves.
    """
    rate_hz = 2000.0 if robot.axes[names[0]].kind == "piezo" else 1000.0
    time_s = np.arange(round((10.0 if rate_hz > 1500.0 else 12.0) * rate_hz)) / rate_hz
    columns = []
    for name in names:
        low, high = travels[name]
        x = _mixed(time_s, rng)
        if robot.axes[name].kind == "stepper":  # speed and acceleration are bound
            x = lagged(x, np.array([-8.0, -8.0, -8.0]), 1.0 / rate_hz)
        busy = 0.003 * _tones(time_s, rng) * (time_s > time_s[-1] - 2.5)
        columns.append(low + (high - low) * (x + busy))
    return Commands(1.0 / rate_hz, np.column_stack(columns))


def _mixed(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    start = rng.uniform(0.2, 0.8)
    knots_s, levels = [0.0, 0.1, 0.3, 0.55, 0.8, 0.9], [start, start, 0.97, 0.03, start, start]
    x = np.interp(time_s, knots_s, levels)
    later = time_s > 1.0
    jumps_s = np.sort(rng.uniform(1.2, time_s[-1] - 0.5, 6))
    places = np.concatenate([[start], rng.uniform(0.1, 0.9, 6)])
    x[later] = _softly(places[np.searchsorted(jumps_s, time_s)], time_s)[later]
    swinging = later & (time_s > rng.uniform(2.0, 6.0))
    room = np.minimum(x, 1.0 - x)
    x[swinging] += (
        0.8 * np.minimum(room, 0.15) * np.sin(2.0 * pi * rng.uniform(1.5, 4.0) * time_s)
    )[swinging]
    return np.asarray(x)
