"""The motion that shows a sensor's errors, as a trajectory inside the axis' limits.

A micro axis (stepper) makes the cycle of ISO 230-2:2014, section 5.3, with the targets
``P_i = (i − 1) p + r``. The random r lets the targets fall on all phases of periodic errors. Each
target is approached without overshoot, from below on the way up and from above on the way down.
After each cycle the axis creeps a short distance at four places, which shows an encoder's
interpolation error.

A nano axis (piezo, force) makes slow triangles of decreasing size, which show the curve and the
hysteresis loop, and quick moves, which show the lag.
"""

from math import inf

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.calibration.iso230 import MIN_ISO_RUNS, MIN_ISO_TARGETS
from rotemina.sim.errors import SensorCalibrationError
from rotemina.sim.excitation import (
    compute_shortest_duration,
    compute_shortest_quintic,
    count_rows,
    make_quintic,
    make_trapezoid,
)
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import Robot, StepperAxis
from rotemina.sim.trajectory import compute_reachable_range

DEFAULT_RUNS = MIN_ISO_RUNS
DEFAULT_TARGETS = 11
DEFAULT_RATE_HZ = 1000.0
_MIN_RUNS, _MAX_RUNS, _MAX_TARGETS = 3, 50, 101
# Share of the range that stays free at each end.
_MARGIN_SHARE = 0.02
# Shares of the permitted speed and acceleration.
_SPEED_SHARE, _ACCELERATION_SHARE = 0.8, 0.5
_HOLD_S, _SWEEP_S = 0.3, 2.0
# Ratio of the acceleration of a sweep to stroke/T². With 10, the axis reaches its speed in about a
# tenth of the sweep.
_SWEEP_ACCELERATION_FACTOR = 10.0
# Such a jump is far slower than the oscillations of an axis, so that the laser's rows can be
# interpolated.
_MIN_JUMP_S = 0.05
# Distance and duration of one creeping motion.
_CREEP_M, _CREEP_S = 2e-4, 1.5
# Each distance between these places is far shorter than the next one, so that the periods between
# two places can be counted.
_CREEP_PLACES = (0.1, 0.115, 0.2, 0.9)
_TRIANGLE_HEIGHTS = (1.0, 0.5, 0.2)
_JUMP_PLACES = (0.2, 0.8, 0.35, 0.65, 0.45, 0.55)
# An axis without declared limits crosses its range in this time.
_CROSSING_S = 1.0


def make_calibration_motion(
    robot: Robot,
    axis: str,
    *,
    runs: int = DEFAULT_RUNS,
    targets: int = DEFAULT_TARGETS,
    rate_hz: float = DEFAULT_RATE_HZ,
    seed: int = 0,
) -> Record:
    """Return the calibration trajectory of one axis, which repeats the same motion in every run.

    Raises
    ------
    SensorCalibrationError
        If the robot has no such axis, or a number is out of bounds.
    """
    if axis not in robot.axes:
        raise SensorCalibrationError(
            "axis {axis}: robot {name} has no such axis; use one of {names}",
            axis=repr(axis),
            name=repr(robot.name),
            names=", ".join(robot.axes),
        )
    _check_settings(runs, targets, rate_hz)
    path = _CalibrationPath(robot, axis, rate_hz)
    is_stepper = isinstance(robot.axes[axis], StepperAxis)
    rng = np.random.default_rng(seed)
    places = _draw_targets(targets, rng)
    path.add_rest(_HOLD_S)
    for _ in range(runs):
        path.add_micro_cycle(places) if is_stepper else path.add_nano_cycle()
    values = path.compute_positions()
    motion_text = f"ISO 230-2 cycles of {targets} targets" if is_stepper else "triangles and moves"
    return Record.from_signals(
        np.arange(len(values)) / rate_hz,
        {(axis, Tap.CMD): values},
        {axis: robot.unit(axis) or "m"},
        {
            "name": f"calibration of {axis}",
            "calibration": f"{axis}: {runs} runs, {motion_text}",
            "calibration_runs": str(runs),
            **({"calibration_targets": str(targets)} if is_stepper else {}),
            "rate_hz": repr(rate_hz),
        },
    )


def _check_settings(runs: int, targets: int, rate_hz: float) -> None:
    for name, value, lower, upper in (
        ("runs", runs, _MIN_RUNS, _MAX_RUNS),
        ("targets", targets, MIN_ISO_TARGETS, _MAX_TARGETS),
        ("rate", rate_hz, 100.0, 20_000.0),
    ):
        if not lower <= value <= upper:
            raise SensorCalibrationError(
                "{name} = {value} is not between {least} and {most}",
                name=name,
                value=value,
                least=lower,
                most=upper,
            )


def _draw_targets(count: int, rng: np.random.Generator) -> FloatArray:
    """Return evenly spaced targets with small random offsets, as shares of the travel."""
    pitch = 1.0 / count
    return (np.arange(count) + 0.5 + rng.uniform(-0.25, 0.25, count)) * pitch


class _CalibrationPath:
    """A trajectory that is extended move by move, in shares 0 … 1 of the travel."""

    def __init__(self, robot: Robot, axis: str, rate_hz: float) -> None:
        model = robot.axes[axis]
        low, high = compute_reachable_range(model)
        self._low = low + _MARGIN_SHARE * (high - low)
        self._span = (1.0 - 2.0 * _MARGIN_SHARE) * (high - low)
        self._rate_hz = rate_hz
        self._stroke_ends = model.range
        speed = _SPEED_SHARE * (model.max_speed or inf) / self._span
        acceleration = _ACCELERATION_SHARE * (model.max_acceleration or inf) / self._span
        self._speed = min(speed, 1.0 / _CROSSING_S) if speed == inf else speed
        self._acceleration = 10.0 if acceleration == inf else acceleration
        self._parts: list[FloatArray] = [np.zeros(1)]

    def compute_positions(self) -> FloatArray:
        """Return the positions (n,), m or rad."""
        values = self._low + self._span * np.concatenate(self._parts)
        return np.clip(values, *self._stroke_ends)

    def add_micro_cycle(self, targets: FloatArray) -> None:
        """Add a cycle of a micro axis: up, down, and creeping at four places."""
        for place in (*targets, 1.0, *targets[::-1], 0.0):
            self._move_to(float(place))
            self.add_rest(_HOLD_S)
        stroke = min(_CREEP_M / self._span, 0.05)
        for place in _CREEP_PLACES:
            self._move_to(place)
            self.add_rest(_HOLD_S)
            self._sweep(place + stroke, _CREEP_S)
            self._sweep(place, _CREEP_S)
        self._move_to(0.0)
        self.add_rest(_HOLD_S)

    def add_nano_cycle(self) -> None:
        """Add a run of a nano axis: triangles of decreasing size and quick moves."""
        for height in _TRIANGLE_HEIGHTS:
            self._sweep(height, _SWEEP_S * height)
            self._sweep(0.0, _SWEEP_S * height)
        for place in (*_JUMP_PLACES, 0.0):
            self._jump(place)
            self.add_rest(0.1)

    def add_rest(self, duration_s: float) -> None:
        self._parts.append(np.full(count_rows(duration_s, self._rate_hz), self._end))

    @property
    def _end(self) -> float:
        return float(self._parts[-1][-1])

    def _move_to(self, place: float) -> None:
        distance = abs(place - self._end)
        if distance:
            duration_s = compute_shortest_duration(distance, self._speed, self._acceleration)
            rows = count_rows(duration_s, self._rate_hz)
            self._parts.append(
                make_trapezoid(self._end, place, rows, self._rate_hz, self._acceleration)
            )

    def _sweep(self, place: float, duration_s: float) -> None:
        distance = abs(place - self._end)
        min_s = compute_shortest_duration(distance, self._speed, self._acceleration)
        duration_s = max(duration_s, min_s)
        # A low acceleration avoids oscillations, which the rows would not resolve.
        acceleration = min(
            self._acceleration, _SWEEP_ACCELERATION_FACTOR * distance / duration_s**2
        )
        rows = count_rows(duration_s, self._rate_hz)
        self._parts.append(make_trapezoid(self._end, place, rows, self._rate_hz, acceleration))

    def _jump(self, place: float) -> None:
        distance = abs(place - self._end)
        duration_s = max(
            compute_shortest_quintic(distance, self._speed, self._acceleration, inf), _MIN_JUMP_S
        )
        self._parts.append(make_quintic(self._end, place, count_rows(duration_s, self._rate_hz)))
