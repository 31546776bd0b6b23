"""The noise floor of a tap: declared by its sensor, or measured in the record and labelled so."""

from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.plant.plant import Plant
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import CascadeController, Robot

_ROUNDING = 1e-12  # of a signal's size
_REST_ROWS = 50  # a hold shorter than this says nothing about noise
_IMPULSE_ROWS = 4000  # samples after which a controller's answer to one noise sample has died


class NoiseFloor(NamedTuple):
    """The unexplainable rms in the tap's SI unit, and its source.

    ``source`` is ``"declared"``, ``"at rest"``, ``"period to period"``, or None with no ``rms``.
    """

    rms: float | None
    source: str | None


def noise_floor(robot: Robot, record: Record, axis: str, tap: Tap) -> NoiseFloor:
    """Return the noise floor of one measured tap of ``record``."""
    declared = _declared(robot, record, axis, tap)
    if declared is not None:
        return NoiseFloor(declared, "declared")
    for source, measure in (("period to period", _between_periods), ("at rest", _at_rest)):
        measured = measure(record, axis, tap)
        if measured is not None:
            return NoiseFloor(measured, source)
    return NoiseFloor(None, None)


def _declared(robot: Robot, record: Record, axis: str, tap: Tap) -> float | None:
    if tap is Tap.REF:
        own = record.reference_noise(axis)
        if own is not None:
            return own
        return robot.reference.noise_rms.of(record.units[axis])
    sensor = robot.axes[axis].sensor
    if sensor is None:
        return None
    if tap is Tap.MEAS:
        return sensor.noise_floor
    if tap is Tap.U and record.closed_loop and len(record.time_s) > 1:
        gain = _noise_gain(robot, axis, float(np.median(np.diff(record.time_s))))
        return None if gain is None else gain * sensor.noise_floor
    return None


def _noise_gain(robot: Robot, axis: str, period_s: float) -> float | None:
    """RMS of a controller's output for white sensor noise of rms 1, through the closed loop.

    The answer to a single noise sample is summed in squares (H2 norm). Noise n on the reading
    equals a set-point of ``-n``, less ``(n_k - n_{k-1}) / (kp dt)`` where speed is differenced.
    """
    described = robot.axes[axis]
    if described.controller is None:
        return None
    loop = described.controller
    linear: CascadeController = replace(loop, limit=1e300)
    free = replace(described, controller=linear)
    whole = replace(robot, axes={**robot.axes, axis: free}, effects=())
    plant = Plant.of(whole, closed_loop=True)
    column = plant.axes.index(axis)
    command = np.zeros((_IMPULSE_ROWS, len(plant.axes)))
    time_s = period_s * np.arange(_IMPULSE_ROWS, dtype=np.float64)
    quiet, _ = plant.advance(plant.at_rest(0.0, command[0]), time_s, command)
    state = plant.at_rest(0.0, command[0])
    differenced = 1.0 / (loop.kp * period_s) if loop.velocity == "backward" else 0.0
    command[1, column] = -1.0 - differenced
    command[2, column] = differenced
    noisy, _ = plant.advance(state, time_s, command)
    answer = noisy.inputs[:, column] - quiet.inputs[:, column]
    return float(np.sqrt(np.sum(answer**2)))


def _between_periods(record: Record, axis: str, tap: Tap) -> float | None:
    period = record.period_samples
    if record.history != "periodic" or period is None or len(record.time_s) < 2 * period:
        return None
    count = len(record.time_s) // period
    periods = record.signal(axis, tap)[: count * period].reshape(count, period)
    floor = float(np.sqrt(np.mean(np.var(periods, axis=0, ddof=1))))
    return floor if _was_measured(floor, periods) else None


def _at_rest(record: Record, axis: str, tap: Tap) -> float | None:
    """Scatter about a line in the second half of every long hold, with the step of the reading."""
    signal = record.signal(axis, tap)
    held = [
        signal[(start + end) // 2 : end]
        for start, end in _holds(record.signal(axis, Tap.CMD))
        if end - start >= _REST_ROWS
    ]
    if not held:
        return None
    residual = np.concatenate([_about_line(part) for part in held])
    # Within a hold alone: from one hold to the next a reading moves by more than its step.
    step = min((size for part in held if (size := _reading_step(part)) > 0.0), default=0.0)
    floor = float(np.sqrt(np.mean(residual**2) + step**2 / 12.0))
    return floor if _was_measured(floor, signal) else None


def _was_measured(floor: float, signal: FloatArray) -> bool:
    """Return whether what scatters is noise: a computed signal has none but its rounding."""
    return floor > _ROUNDING * float(np.abs(signal).max())


def _holds(command: FloatArray) -> list[tuple[int, int]]:
    edges = np.flatnonzero(np.diff(command) != 0.0) + 1
    bounds = np.concatenate([[0], edges, [len(command)]])
    return [(a, b) for a, b in pairwise(bounds.tolist())]


def _about_line(signal: FloatArray) -> FloatArray:
    rows = np.arange(len(signal), dtype=np.float64)
    line = np.polynomial.polynomial.polyfit(rows, signal, 1)
    return np.asarray(signal - np.polynomial.polynomial.polyval(rows, line))


def _reading_step(signal: FloatArray) -> float:
    """Smallest difference between readings where they sit on a grid, else 0."""
    levels = np.unique(signal)
    if len(levels) < 2 or len(levels) > len(signal) // 4:
        return 0.0
    return float(np.diff(levels).min())
