"""The noise floor of a tap, declared by its sensor or measured in the record."""

from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.plant import Plant
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import CascadeController, Robot

# Scatter below this fraction of the signal's size is rounding.
_ROUNDING_SHARE = 1e-12
# Shorter holds do not show the noise.
_MIN_REST_ROWS = 50
# The response of a controller to a single noise sample ends within this many samples.
_IMPULSE_ROWS = 4000


class NoiseFloor(NamedTuple):
    """The rms that no model can explain, in the SI unit of the tap, and where it comes from.

    ``source`` is ``"declared"``, ``"at rest"`` or ``"period to period"``; None if ``rms`` is.
    """

    rms: float | None
    source: str | None


def find_noise_floor(robot: Robot, record: Record, axis: str, tap: Tap) -> NoiseFloor:
    """Return the noise floor of one measured tap of ``record``."""
    declared_floor = _find_declared_floor(robot, record, axis, tap)
    if declared_floor is not None:
        return NoiseFloor(declared_floor, "declared")
    for source, measure in (
        ("period to period", _measure_between_periods),
        ("at rest", _measure_at_rest),
    ):
        measured_floor = measure(record, axis, tap)
        if measured_floor is not None:
            return NoiseFloor(measured_floor, source)
    return NoiseFloor(None, None)


def _find_declared_floor(robot: Robot, record: Record, axis: str, tap: Tap) -> float | None:
    if tap is Tap.REF:
        recorded_noise = record.reference_noise(axis)
        if recorded_noise is not None:
            return recorded_noise
        return robot.reference.noise_rms.of(record.units[axis])
    sensor = robot.axes[axis].sensor
    if sensor is None:
        return None
    if tap is Tap.MEAS:
        return sensor.noise_floor
    if tap is Tap.U and record.closed_loop and len(record.time_s) > 1:
        gain = _compute_noise_gain(robot, axis, float(np.median(np.diff(record.time_s))))
        return None if gain is None else gain * sensor.noise_floor
    return None


def _compute_noise_gain(robot: Robot, axis: str, period_s: float) -> float | None:
    """Return the rms of a controller's output for white sensor noise of rms 1, in closed loop.

    The squares of the response to a single noise sample are summed (H2 norm). Noise n on the
    reading is equivalent to a set-point of ``-n``. If the controller computes the speed as a
    difference, ``(n_k - n_{k-1}) / (kp dt)`` is subtracted as well.
    """
    axis_model = robot.axes[axis]
    if axis_model.controller is None:
        return None
    controller = axis_model.controller
    unlimited: CascadeController = replace(controller, limit=1e300)
    unlimited_axis = replace(axis_model, controller=unlimited)
    changed_robot = replace(robot, axes={**robot.axes, axis: unlimited_axis}, effects=())
    plant = Plant.of(changed_robot, closed_loop=True)
    column = plant.axes.index(axis)
    command = np.zeros((_IMPULSE_ROWS, len(plant.axes)))
    time_s = period_s * np.arange(_IMPULSE_ROWS, dtype=np.float64)
    quiet_run, _ = plant.advance(plant.find_rest_state(0.0, command[0]), time_s, command)
    state = plant.find_rest_state(0.0, command[0])
    difference_gain = 1.0 / (controller.kp * period_s) if controller.velocity == "backward" else 0.0
    command[1, column] = -1.0 - difference_gain
    command[2, column] = difference_gain
    noisy_run, _ = plant.advance(state, time_s, command)
    response = noisy_run.inputs[:, column] - quiet_run.inputs[:, column]
    return float(np.sqrt(np.sum(response**2)))


def _measure_between_periods(record: Record, axis: str, tap: Tap) -> float | None:
    period = record.period_samples
    if record.history != "periodic" or period is None or len(record.time_s) < 2 * period:
        return None
    count = len(record.time_s) // period
    periods = record.signal(axis, tap)[: count * period].reshape(count, period)
    floor = float(np.sqrt(np.mean(np.var(periods, axis=0, ddof=1))))
    return floor if _is_noise(floor, periods) else None


def _measure_at_rest(record: Record, axis: str, tap: Tap) -> float | None:
    """Return the rms noise in the second halves of all long holds.

    It combines the scatter about a fitted line with the rounding to the step of the reading.
    """
    signal = record.signal(axis, tap)
    holds = [
        signal[(start + end) // 2 : end]
        for start, end in _find_holds(record.signal(axis, Tap.CMD))
        if end - start >= _MIN_REST_ROWS
    ]
    if not holds:
        return None
    residual = np.concatenate([_subtract_line(part) for part in holds])
    # Only differences within a hold count, because a reading moves by more than its step from one
    # hold to the next.
    step = min((size for part in holds if (size := _find_reading_step(part)) > 0.0), default=0.0)
    floor = float(np.sqrt(np.mean(residual**2) + step**2 / 12.0))
    return floor if _is_noise(floor, signal) else None


def _is_noise(floor: float, signal: FloatArray) -> bool:
    """Return whether the scatter is noise. A computed signal has only rounding errors."""
    return floor > _ROUNDING_SHARE * float(np.abs(signal).max())


def _find_holds(command: FloatArray) -> list[tuple[int, int]]:
    edges = np.flatnonzero(np.diff(command) != 0.0) + 1
    bounds = np.concatenate([[0], edges, [len(command)]])
    return [(a, b) for a, b in pairwise(bounds.tolist())]


def _subtract_line(signal: FloatArray) -> FloatArray:
    rows = np.arange(len(signal), dtype=np.float64)
    line = np.polynomial.polynomial.polyfit(rows, signal, 1)
    return np.asarray(signal - np.polynomial.polynomial.polyval(rows, line))


def _find_reading_step(signal: FloatArray) -> float:
    """Return the smallest difference between readings if they lie on a grid, otherwise 0."""
    levels = np.unique(signal)
    if len(levels) < 2 or len(levels) > len(signal) // 4:
        return 0.0
    return float(np.diff(levels).min())
