"""What a whole trajectory exceeds: range, voltage, speed and acceleration of each axis.

A trajectory is judged as a device plays it, holding each row until the next
(:mod:`rotemina.sim.trajectory.speed_and_acceleration`).
"""

from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.messages import AxisName, Message, lines, message
from rotemina.sim.quantities import exact, rounded
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Axis, ForceAxis, PiezoAxis, Robot
from rotemina.sim.trajectory.axis_limits import (
    RANGE_SLACK,
    OutOfLimitsError,
    resolution_of,
    voltage_bounds,
    voltage_slack,
)
from rotemina.sim.trajectory.speed_and_acceleration import (
    SETPOINT_PERIOD_S,
    accelerations,
    held_rows,
    jump_speeds,
    jump_times,
)

RATE_SLACK = 1e-6  # relative, of speed and acceleration


class TrajectoryError(InputError):
    """A trajectory that this robot cannot play, whatever its limits."""


class Quantity(StrEnum):
    """What a bound limits."""

    RANGE = "range"
    VOLTAGE = "voltage"
    SPEED = "speed"
    ACCELERATION = "acceleration"
    MOTION = "predicted motion"


@dataclass(frozen=True, slots=True)
class Violation:
    """The worst excess of one axis over one bound; ``value`` and ``bound`` in ``unit`` (SI).

    ``time_s`` is on the trajectory's own time; the bound is signed like the value. ``advice`` says
    what to do. ``row`` counts from 1; None where it lies between rows.
    """

    axis: str
    quantity: Quantity
    time_s: float
    value: float
    bound: float
    unit: str
    advice: Message
    row: int | None = None

    @property
    def message(self) -> Message:
        """The problem with place, value, bound and remedy."""
        value = exact(self.value, self.unit, size=self.bound)
        bound = exact(self.bound, self.unit)
        what = "position" if self.quantity is Quantity.RANGE else self.quantity
        said = message(
            "engine",
            "axis {axis}: {what} {value} at {row}t = {time} s is beyond the limit {bound}; "
            "{advice}",
        )
        row = message("engine", "row {row}, ")
        return said.fill(
            axis=AxisName(self.axis),
            what=str(what),
            value=value,
            row="" if self.row is None else row.fill(row=self.row),
            time=self.time_s,
            bound=bound,
            advice=self.advice,
        )

    def __str__(self) -> str:
        return self.message


def check_trajectory(
    robot: Robot, trajectory: Record, *, setpoint_period_s: float = SETPOINT_PERIOD_S
) -> None:
    """Refuse a trajectory that exceeds a limit.

    Raises
    ------
    TrajectoryError
        If the trajectory is not one for this robot.
    OutOfLimitsError
        Naming every axis and quantity that is exceeded.
    """
    violations = find_violations(robot, trajectory, setpoint_period_s=setpoint_period_s)
    if violations:
        raise OutOfLimitsError(lines(violation.message for violation in violations))


def find_violations(
    robot: Robot, trajectory: Record, *, setpoint_period_s: float = SETPOINT_PERIOD_S
) -> tuple[Violation, ...]:
    """Return the worst excess of each axis and quantity; none where the trajectory may run.

    Only ``cmd`` channels count. The robot is taken to rest at the first command before the
    trajectory and at the last one after it. From one row to the next the device goes within
    ``setpoint_period_s``, and until then it holds.

    Raises
    ------
    TrajectoryError
        As :func:`commands_of`.
    """
    found: list[Violation] = []
    for name, command in commands_of(robot, trajectory).items():
        path = _Path(
            name,
            robot.axes[name],
            trajectory.units[name],
            trajectory.time_s,
            command,
            setpoint_period_s,
        )
        for violation in (
            _range_violation(path),
            _voltage_violation(path),
            _speed_violation(path),
            _acceleration_violation(path),
        ):
            if violation is not None:
                found.append(violation)
    return tuple(found)


class _Path(NamedTuple):
    """The commands (n,) of one axis at times (n,), and how soon a device goes to each."""

    name: str
    axis: Axis
    unit: str
    time_s: FloatArray
    command: FloatArray
    period_s: float


def commands_of(robot: Robot, trajectory: Record) -> dict[str, FloatArray]:
    """Return the (n,) commands of each axis that a trajectory moves, m or rad.

    Raises
    ------
    TrajectoryError
        If it has no commands, names an axis that the robot lacks, gives one in the wrong
        quantity, or moves an axis by a force that no controller holds.
    """
    names = [channel.axis for channel in trajectory.columns if channel.tap is Tap.CMD]
    if not names:
        raise TrajectoryError(
            message(
                "engine",
                "trajectory: it has no set-point column (axis.cmd); a trajectory needs at "
                "least one",
            )
        )
    for name in names:
        _check_axis(robot, name, trajectory.units[name])
    return {name: trajectory.signal(name, Tap.CMD) for name in names}


def _check_axis(robot: Robot, name: str, unit: str) -> None:
    if name not in robot.axes:
        raise TrajectoryError(
            message(
                "engine",
                "trajectory: robot {name} has no axis {axis}, only {axes}; rename "
                "the column or choose the robot it was made for",
            ).fill(name=repr(robot.name), axis=repr(name), axes=", ".join(robot.axes))
        )
    expected = robot.unit(name)
    if expected is not None and unit != expected:
        raise TrajectoryError(
            message(
                "engine",
                "trajectory: axis {name} is given in {unit}, but the robot's moves in {expected}",
            ).fill(name=AxisName(name), unit=unit, expected=expected)
        )
    axis = robot.axes[name]
    if isinstance(axis, ForceAxis) and axis.controller is None:
        raise TrajectoryError(
            message(
                "engine",
                "trajectory: axis {name} is moved by a force and has no controller "
                "in the robot file, so nothing would make it follow; add "
                "[axis.{key}.controller]",
            ).fill(name=AxisName(name), key=name)
        )


def _worst_outside(
    values: FloatArray, bounds: tuple[float, float], slack: float
) -> tuple[int, float] | None:
    """Return row and bound of the value farthest outside ``bounds``, or None."""
    excess = np.maximum(bounds[0] - values, values - bounds[1])
    row = int(np.argmax(excess))
    if excess[row] <= slack:
        return None
    return row, bounds[0] if values[row] < bounds[0] else bounds[1]


def _range_violation(path: _Path) -> Violation | None:
    worst = _worst_outside(path.command, path.axis.range, RANGE_SLACK * path.axis.span)
    if worst is None:
        return None
    row, bound = worst
    value = float(path.command[row])
    advice = message(
        "engine", "move or shrink the trajectory so that it stays inside the axis range"
    )
    time_s = float(path.time_s[row])
    return Violation(path.name, Quantity.RANGE, time_s, value, bound, path.unit, advice, row + 1)


def _voltage_violation(path: _Path) -> Violation | None:
    bounds = voltage_bounds(path.axis)
    if bounds is None or not isinstance(path.axis, PiezoAxis):
        return None
    voltage = path.command / path.axis.gain
    worst = _worst_outside(voltage, bounds, voltage_slack(bounds))
    if worst is None:
        return None
    row, bound = worst
    advice = message("engine", "move or shrink the trajectory so that the amplifier can follow")
    time_s = float(path.time_s[row])
    value = float(voltage[row])
    return Violation(path.name, Quantity.VOLTAGE, time_s, value, bound, "V", advice, row + 1)


def _speed_violation(path: _Path) -> Violation | None:
    most = path.axis.max_speed
    if most is None or len(path.time_s) < 2:
        return None
    speed = jump_speeds(path.time_s, path.command, path.period_s)
    rounding = resolution_of(path.axis) + _float_rounding(path.command)
    allowed = most * (1.0 + RATE_SLACK) + rounding / jump_times(path.time_s, path.period_s)
    excess = np.abs(speed) - allowed
    row = int(np.argmax(excess))
    if excess[row] <= 0:
        return None
    value = float(speed[row])
    bound = float(np.copysign(most, value))
    interval = float(path.time_s[row + 1] - path.time_s[row])
    straight = float(path.command[row + 1] - path.command[row]) / interval / bound
    advice = _stretch(straight)
    if held_rows(path.time_s[row : row + 2], path.period_s)[0]:
        advice = _resample(interval, path.period_s)
        if straight > 1.0 + RATE_SLACK:
            both = message("engine", "{one}, and {other}")
            advice = both.fill(one=advice, other=_stretch(straight))
    time_s = float(path.time_s[row + 1])
    return Violation(
        path.name, Quantity.SPEED, time_s, value, bound, f"{path.unit}/s", advice, row + 2
    )


def _acceleration_violation(path: _Path) -> Violation | None:
    most = path.axis.max_acceleration
    if most is None or len(path.time_s) < 2:
        return None
    resolution = resolution_of(path.axis)
    # Four roundings enter a second difference: two of the middle command, one of each other.
    rounding = 4.0 * (resolution + _float_rounding(path.command))
    worst, value, time_s = 0.0, 0.0, 0.0
    for seen in accelerations(path.time_s, path.command, resolution, most, path.period_s):
        allowed = most * (1.0 + RATE_SLACK) + rounding / seen.window_s**2
        excess = np.abs(seen.value) - allowed
        at = int(np.argmax(excess))
        if excess[at] > worst:
            worst, value, time_s = float(excess[at]), float(seen.value[at]), float(seen.time_s[at])
    if worst <= 0:
        return None
    bound = float(np.copysign(most, value))
    row = min(int(np.searchsorted(path.time_s, time_s, side="left")), len(path.time_s) - 1)
    around = path.time_s[max(row - 1, 0) : row + 2]
    held = held_rows(around, path.period_s)
    advice = _stretch((value / bound) ** 0.5)
    if held.any():
        advice = _resample(float(np.diff(around).max()), path.period_s)
    unit = f"{path.unit}/s²"
    return Violation(path.name, Quantity.ACCELERATION, time_s, value, bound, unit, advice, row + 1)


def _stretch(factor: float) -> Message:
    said = message("engine", "stretch its time by a factor of {factor} or more, or smooth it there")
    return said.fill(factor=rounded(factor, 3))


def _resample(interval_s: float, period_s: float) -> Message:
    """Say what to do about rows that are farther apart than the device's set-points."""
    said = message(
        "engine",
        "rows are {interval} s apart there and the device holds each, then jumps: resample the "
        "trajectory at {rate} Hz (linear or cubic)",
    )
    return said.fill(interval=rounded(interval_s, 3), rate=1.0 / period_s)


def _float_rounding(command: FloatArray) -> float:
    return 4.0 * float(np.finfo(np.float64).eps) * float(np.abs(command).max())
