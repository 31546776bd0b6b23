"""Check of a whole trajectory against the range, voltage, speed and acceleration of each axis.

A trajectory is checked as a device plays it, holding each row until the next one
(:mod:`rotemina.sim.trajectory.speed_and_acceleration`).
"""

from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import OutOfLimitsError, TrajectoryError
from rotemina.sim.messages import AxisName, Message, format_rounded, join_lines, message
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import (
    Axis,
    ForceAxis,
    PiezoAxis,
    Robot,
)
from rotemina.sim.trajectory.axis_limits import (
    RANGE_SLACK_RATIO,
    get_command_resolution,
    get_voltage_bounds,
    voltage_slack,
)
from rotemina.sim.trajectory.speed_and_acceleration import (
    DEFAULT_SETPOINT_PERIOD_S,
    compute_accelerations,
    compute_jump_speeds,
    compute_jump_times,
    find_held_intervals,
)
from rotemina.sim.units import format_exact

# Permitted excess of speed and acceleration, relative to their limits.
RATE_SLACK_RATIO = 1e-6


class LimitedQuantity(StrEnum):
    """The quantity that a bound limits."""

    RANGE = "range"
    VOLTAGE = "voltage"
    SPEED = "speed"
    ACCELERATION = "acceleration"
    MOTION = "predicted motion"


@dataclass(frozen=True, slots=True)
class LimitViolation:
    """The worst excess of one axis over one bound; ``value`` and ``bound`` in ``unit`` (SI).

    ``time_s`` is the time of the trajectory. The bound has the sign of the value. ``advice`` says
    what to do. ``row`` counts from 1; None if the excess is between rows.
    """

    axis: str
    quantity: LimitedQuantity
    time_s: float
    value: float
    bound: float
    unit: str
    advice: Message
    row: int | None = None

    @property
    def message(self) -> Message:
        """The violation with its time, value, bound and advice."""
        value = format_exact(self.value, self.unit, size=self.bound)
        bound = format_exact(self.bound, self.unit)
        quantity_name = "position" if self.quantity is LimitedQuantity.RANGE else self.quantity
        template = message(
            "engine",
            "axis {axis}: {what} {value} at {row}t = {time} s is beyond the limit {bound}; "
            "{advice}",
        )
        row_text = message("engine", "row {row}, ")
        return template.fill(
            axis=AxisName(self.axis),
            what=str(quantity_name),
            value=value,
            row="" if self.row is None else row_text.fill(row=self.row),
            time=self.time_s,
            bound=bound,
            advice=self.advice,
        )

    def __str__(self) -> str:
        return self.message


def check_trajectory(
    robot: Robot, trajectory: Record, *, setpoint_period_s: float = DEFAULT_SETPOINT_PERIOD_S
) -> None:
    """Refuse a trajectory that exceeds a limit.

    Raises
    ------
    TrajectoryError
        If the trajectory does not fit this robot.
    OutOfLimitsError
        If a limit is exceeded; the message lists every axis and quantity beyond its bound.
    """
    violations = find_violations(robot, trajectory, setpoint_period_s=setpoint_period_s)
    if violations:
        raise OutOfLimitsError(join_lines(violation.message for violation in violations))


def find_violations(
    robot: Robot, trajectory: Record, *, setpoint_period_s: float = DEFAULT_SETPOINT_PERIOD_S
) -> tuple[LimitViolation, ...]:
    """Return the worst excess of each axis and quantity; empty if the trajectory may be played.

    Only ``cmd`` channels count. The robot is assumed to rest at the first command before the
    trajectory and at the last one after it. The device holds each row and moves to the next one
    within ``setpoint_period_s``.

    Raises
    ------
    TrajectoryError
        As in :func:`commands_of`.
    """
    violations: list[LimitViolation] = []
    for name, command in commands_of(robot, trajectory).items():
        path = _AxisPath(
            name,
            robot.axes[name],
            trajectory.units[name],
            trajectory.time_s,
            command,
            setpoint_period_s,
        )
        for violation in (
            _find_range_violation(path),
            _find_voltage_violation(path),
            _find_speed_violation(path),
            _find_acceleration_violation(path),
        ):
            if violation is not None:
                violations.append(violation)
    return tuple(violations)


class _AxisPath(NamedTuple):
    name: str
    axis: Axis
    unit: str
    time_s: FloatArray
    command: FloatArray
    period_s: float


def commands_of(robot: Robot, trajectory: Record) -> dict[str, FloatArray]:
    """Return the commands (n,) of each axis of a trajectory, m or rad.

    Raises
    ------
    TrajectoryError
        If the trajectory has no commands, an axis that the robot lacks, a command in the wrong
        quantity, or an axis that is moved by a force without a controller.
    """
    names = [channel.axis for channel in trajectory.columns if channel.tap is Tap.CMD]
    if not names:
        raise TrajectoryError(
            "trajectory: it has no set-point column (axis.cmd); a trajectory needs at least one"
        )
    for name in names:
        _check_axis(robot, name, trajectory.units[name])
    return {name: trajectory.signal(name, Tap.CMD) for name in names}


def _check_axis(robot: Robot, name: str, unit: str) -> None:
    if name not in robot.axes:
        raise TrajectoryError(
            "trajectory: robot {name} has no axis {axis}, only {axes}; rename "
            "the column or choose the robot it was made for",
            name=repr(robot.name),
            axis=repr(name),
            axes=", ".join(robot.axes),
        )
    expected = robot.unit(name)
    if expected is not None and unit != expected:
        raise TrajectoryError(
            "trajectory: axis {name} is in units of {unit}, but the robot moves it in units of "
            "{expected}; correct the unit",
            name=AxisName(name),
            unit=unit,
            expected=expected,
        )
    axis = robot.axes[name]
    if isinstance(axis, ForceAxis) and axis.controller is None:
        raise TrajectoryError(
            "trajectory: axis {name} is moved by a force and has no controller in the robot "
            "file, so it cannot follow commands; add [axis.{key}.controller]",
            name=AxisName(name),
            key=name,
        )


def _find_worst_outside(
    values: FloatArray, bounds: tuple[float, float], slack: float
) -> tuple[int, float] | None:
    """Return the row and the exceeded bound of the value farthest outside ``bounds``, or None."""
    excess = np.maximum(bounds[0] - values, values - bounds[1])
    row = int(np.argmax(excess))
    if excess[row] <= slack:
        return None
    return row, bounds[0] if values[row] < bounds[0] else bounds[1]


def _find_range_violation(path: _AxisPath) -> LimitViolation | None:
    worst = _find_worst_outside(path.command, path.axis.range, RANGE_SLACK_RATIO * path.axis.span)
    if worst is None:
        return None
    row, bound = worst
    value = float(path.command[row])
    advice = message(
        "engine", "move or shrink the trajectory so that it stays inside the axis range"
    )
    time_s = float(path.time_s[row])
    return LimitViolation(
        path.name, LimitedQuantity.RANGE, time_s, value, bound, path.unit, advice, row + 1
    )


def _find_voltage_violation(path: _AxisPath) -> LimitViolation | None:
    bounds = get_voltage_bounds(path.axis)
    if bounds is None or not isinstance(path.axis, PiezoAxis):
        return None
    voltage = path.command / path.axis.gain
    worst = _find_worst_outside(voltage, bounds, voltage_slack(bounds))
    if worst is None:
        return None
    row, bound = worst
    advice = message("engine", "move or shrink the trajectory so that the amplifier can follow")
    time_s = float(path.time_s[row])
    value = float(voltage[row])
    return LimitViolation(
        path.name, LimitedQuantity.VOLTAGE, time_s, value, bound, "V", advice, row + 1
    )


def _find_speed_violation(path: _AxisPath) -> LimitViolation | None:
    limit = path.axis.max_speed
    if limit is None or len(path.time_s) < 2:
        return None
    speed = compute_jump_speeds(path.time_s, path.command, path.period_s)
    rounding = get_command_resolution(path.axis) + _compute_float_rounding(path.command)
    permitted = limit * (1.0 + RATE_SLACK_RATIO) + rounding / compute_jump_times(
        path.time_s, path.period_s
    )
    excess = np.abs(speed) - permitted
    row = int(np.argmax(excess))
    if excess[row] <= 0:
        return None
    value = float(speed[row])
    bound = float(np.copysign(limit, value))
    interval = float(path.time_s[row + 1] - path.time_s[row])
    ratio_without_hold = float(path.command[row + 1] - path.command[row]) / interval / bound
    advice = _advise_stretching(ratio_without_hold)
    if find_held_intervals(path.time_s[row : row + 2], path.period_s)[0]:
        advice = _advise_resampling(interval, path.period_s)
        if ratio_without_hold > 1.0 + RATE_SLACK_RATIO:
            template = message("engine", "{one}, and {other}")
            advice = template.fill(one=advice, other=_advise_stretching(ratio_without_hold))
    time_s = float(path.time_s[row + 1])
    return LimitViolation(
        path.name, LimitedQuantity.SPEED, time_s, value, bound, f"{path.unit}/s", advice, row + 2
    )


def _find_acceleration_violation(path: _AxisPath) -> LimitViolation | None:
    limit = path.axis.max_acceleration
    if limit is None or len(path.time_s) < 2:
        return None
    resolution = get_command_resolution(path.axis)
    # Four roundings enter a second difference: that of the middle command twice, each other once.
    rounding = 4.0 * (resolution + _compute_float_rounding(path.command))
    worst_excess, value, time_s = 0.0, 0.0, 0.0
    for piece in compute_accelerations(path.time_s, path.command, resolution, limit, path.period_s):
        permitted = limit * (1.0 + RATE_SLACK_RATIO) + rounding / piece.window_s**2
        excess = np.abs(piece.value) - permitted
        index = int(np.argmax(excess))
        if excess[index] > worst_excess:
            worst_excess, value, time_s = (
                float(excess[index]),
                float(piece.value[index]),
                float(piece.time_s[index]),
            )
    if worst_excess <= 0:
        return None
    bound = float(np.copysign(limit, value))
    row = min(int(np.searchsorted(path.time_s, time_s, side="left")), len(path.time_s) - 1)
    nearby_times_s = path.time_s[max(row - 1, 0) : row + 2]
    is_held = find_held_intervals(nearby_times_s, path.period_s)
    advice = _advise_stretching((value / bound) ** 0.5)
    if is_held.any():
        advice = _advise_resampling(float(np.diff(nearby_times_s).max()), path.period_s)
    unit = f"{path.unit}/s²"
    return LimitViolation(
        path.name, LimitedQuantity.ACCELERATION, time_s, value, bound, unit, advice, row + 1
    )


def _advise_stretching(factor: float) -> Message:
    template = message(
        "engine", "stretch its time by a factor of {factor} or more, or smooth it there"
    )
    return template.fill(factor=format_rounded(factor, 3))


def _advise_resampling(interval_s: float, period_s: float) -> Message:
    template = message(
        "engine",
        "rows are {interval} s apart there and the device holds each, then jumps: resample the "
        "trajectory at {rate} Hz (linear or cubic)",
    )
    return template.fill(interval=format_rounded(interval_s, 3), rate=1.0 / period_s)


def _compute_float_rounding(command: FloatArray) -> float:
    return 4.0 * float(np.finfo(np.float64).eps) * float(np.abs(command).max())
