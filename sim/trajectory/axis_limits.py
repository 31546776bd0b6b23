"""The limits of a machine's axes: one rule for the targets of all motion.

Every path that moves an axis (jog, click, playback, script) asks here, or for a whole trajectory
:mod:`rotemina.sim.trajectory.trajectory_excesses`. An axis without a declared bound is not checked
against it.
"""

from collections.abc import Mapping
from dataclasses import replace
from math import inf, isfinite
from numbers import Real
from types import MappingProxyType

import numpy as np

from rotemina.sim.errors import InputError
from rotemina.sim.messages import AxisName, Message, message
from rotemina.sim.quantities import exact, rounded
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import VOLTAGE_SLACK, Axis, PiezoAxis, Robot

RANGE_SLACK = 1e-9  # of the range's length: units are converted with rounding
FOREIGN_SHARE = 0.05  # of the travel, by which no machine is commanded beyond its own range


class OutOfLimitsError(InputError):
    """A target or trajectory that the machine must not be given."""


def is_finite(value: object) -> bool:
    """Whether a value is a finite number."""
    return isinstance(value, Real) and isfinite(value)


def check_speeds(targets: Mapping[str, float], speeds: Mapping[str, float]) -> None:
    """Refuse speeds, m/s or rad/s, at which axes cannot be sent to their targets.

    Raises
    ------
    OutOfLimitsError
        If a speed is no finite number above 0, or of an axis without a target.
    """
    for axis, speed in speeds.items():
        if axis not in targets or not is_finite(speed) or speed <= 0.0:
            raise OutOfLimitsError(
                message(
                    "engine",
                    "axis {axis}: speed {speed}: must be a finite number above 0, of an axis "
                    "with a target",
                ).fill(axis=AxisName(axis), speed=repr(speed))
            )


def check_target(robot: Robot, axis: str, position: float) -> None:
    """Refuse a target that axis must not be sent to; ``position`` in m or rad.

    Raises
    ------
    OutOfLimitsError
        If the robot has no such axis, the position is no finite number, lies outside the range,
        or needs a voltage that the amplifier must not put out.
    """
    if axis not in robot.axes:
        raise OutOfLimitsError(
            message("engine", "axis {axis}: robot {name} has no such axis; use one of {axes}").fill(
                axis=repr(axis), name=repr(robot.name), axes=", ".join(robot.axes)
            )
        )
    if not is_finite(position):
        raise OutOfLimitsError(
            message("engine", "axis {axis}: the target {position} is not a finite number").fill(
                axis=AxisName(axis), position=repr(position)
            )
        )
    model, unit = robot.axes[axis], robot.unit(axis) or ""
    low, high = model.range
    if _outside(position, low, high) > RANGE_SLACK * model.span:
        raise OutOfLimitsError(
            message(
                "engine",
                "axis {axis}: target {position} is outside its range {low} to "
                "{high}; choose a target inside",
            ).fill(
                axis=AxisName(axis),
                position=exact(position, unit, size=high),
                low=exact(low, unit, size=high),
                high=exact(high, unit),
            )
        )
    bounds = voltage_bounds(model)
    if bounds is None or not isinstance(model, PiezoAxis):
        return
    voltage = position / model.gain
    if _outside(voltage, *bounds) > voltage_slack(bounds):
        raise OutOfLimitsError(
            message(
                "engine",
                "axis {axis}: target {position} needs {voltage} V, outside the "
                "amplifier's {low} V to {high} V; choose a target nearer to "
                "rest",
            ).fill(
                axis=AxisName(axis),
                position=exact(position, unit),
                voltage=rounded(voltage, 6),
                low=rounded(bounds[0], 6),
                high=rounded(bounds[1], 6),
            )
        )


def check_commands_of_model(
    robot: Robot, record: Record, name: object, remedy: Message, first_row: int = 1
) -> None:
    """Refuse a record that another machine than the model must have made.

    Only commands count. A machine may swing or read beyond its range, but nobody commands it far
    outside.

    Parameters
    ----------
    robot : Robot
    record : Record
    name : object
        What messages call the record.
    remedy : Message
        How to choose another model here.
    first_row : int
        Number of the first row, where the record is a part of a longer one.

    Raises
    ------
    OutOfLimitsError
        If a command is outside the range by more than ``FOREIGN_SHARE`` of the travel.
    """
    for axis in record.axes:
        if axis not in robot.axes or not record.has(axis, Tap.CMD):
            continue
        command, model = record.signal(axis, Tap.CMD), robot.axes[axis]
        low, high = model.range
        outside = np.maximum(low - command, command - high)
        row = int(np.argmax(outside))
        slack = FOREIGN_SHARE * model.span
        if outside[row] <= slack:
            continue
        unit = record.units[axis]
        bound = low - slack if command[row] < low else high + slack
        raise OutOfLimitsError(
            message(
                "engine",
                "{name}: {axis}.cmd = {value} at row {row} is outside the range {low} to {high} of "
                "the model {model} by more than 5 % of the travel (bound {bound}). If this is a "
                "record of another machine, {remedy}; otherwise correct the unit in the record or "
                "the range in the robot file",
            ).fill(
                name=str(name),
                axis=axis,
                value=exact(float(command[row]), unit, size=bound),
                row=first_row + row,
                low=exact(low, unit, size=high),
                high=exact(high, unit),
                model=robot.name,
                bound=exact(bound, unit, size=high),
                remedy=remedy,
            )
        )


def voltage_bounds(axis: Axis) -> tuple[float, float] | None:
    """Return the voltages between which ``cmd/gain`` must lie, V; None where no such rule binds.

    Under a controller the voltage is not ``cmd/gain``, and the controller's limit clips it.
    """
    if not isinstance(axis, PiezoAxis) or axis.controller is not None:
        return None
    return axis.voltage_range


def reachable(axis: Axis) -> tuple[float, float]:
    """Return the part of the range that an axis' amplifier can hold it in, m or rad."""
    low, high = axis.range
    bounds = voltage_bounds(axis)
    if bounds is None or not isinstance(axis, PiezoAxis):
        return low, high
    ends = sorted(voltage * axis.gain for voltage in bounds)
    return max(low, ends[0]), min(high, ends[1])


def with_limits(
    robot: Robot,
    speeds: Mapping[str, float],
    accelerations: Mapping[str, float] = MappingProxyType({}),
) -> Robot:
    """Return a robot whose axes have these limits, or their own ones where those are stricter.

    Parameters
    ----------
    robot : Robot
    speeds, accelerations : mapping axis -> float
        m/s or rad/s, and m/s² or rad/s², above 0. Other axes keep their limits.
    """
    axes = dict(robot.axes)
    for name, most in speeds.items():
        axes[name] = replace(axes[name], max_speed=min(most, axes[name].max_speed or inf))
    for name, most in accelerations.items():
        axis = axes[name]
        axes[name] = replace(axis, max_acceleration=min(most, axis.max_acceleration or inf))
    return replace(robot, axes=axes)


def resolution_of(axis: Axis) -> float:
    """Return what commands may be rounded to, m or rad: the sensor's resolution, or 0."""
    return axis.sensor.resolution if axis.sensor is not None else 0.0


def _outside(value: float, low: float, high: float) -> float:
    return max(low - value, value - high)


def voltage_slack(bounds: tuple[float, float]) -> float:
    """Return by how much, V, rounding may exceed these bounds."""
    return VOLTAGE_SLACK * max(abs(bounds[0]), abs(bounds[1]))
