"""The limits of a machine's axes: one check for the targets of all motion.

Everything that moves an axis (jog, click, playback, script) checks its targets here. A whole
trajectory is checked by :mod:`rotemina.sim.trajectory.trajectory_excesses`. A bound that is not
declared is not checked.
"""

from collections.abc import Mapping
from dataclasses import replace
from math import inf, isfinite
from numbers import Real
from types import MappingProxyType

import numpy as np

from rotemina.sim.errors import OutOfLimitsError
from rotemina.sim.messages import AxisName, Message, format_rounded
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import (
    VOLTAGE_SLACK_RATIO,
    Axis,
    PiezoAxis,
    Robot,
)
from rotemina.sim.units import format_exact

# Permitted excess of a range, relative to its length, because unit conversion rounds.
RANGE_SLACK_RATIO = 1e-9
# Commands that exceed the range by more than this fraction of the travel are for another machine.
MAX_OUTSIDE_RANGE_RATIO = 0.05


def is_finite(value: object) -> bool:
    """Return whether a value is a finite number."""
    return isinstance(value, Real) and isfinite(value)


def check_speeds(targets: Mapping[str, float], speeds: Mapping[str, float]) -> None:
    """Refuse invalid speeds, m/s or rad/s, for the motion to targets.

    Raises
    ------
    OutOfLimitsError
        If a speed is not a finite number above 0, or belongs to an axis without a target.
    """
    for axis, speed in speeds.items():
        if axis not in targets or not is_finite(speed) or speed <= 0.0:
            raise OutOfLimitsError(
                "axis {axis}: speed {speed}: must be a finite number above 0, for an axis with "
                "a target",
                axis=AxisName(axis),
                speed=repr(speed),
            )


def check_target(robot: Robot, axis: str, position: float) -> None:
    """Refuse a target of an axis that is outside its limits; ``position`` in m or rad.

    Raises
    ------
    OutOfLimitsError
        If the robot has no such axis, or the position is not a finite number, is outside the range,
        or needs a voltage outside the amplifier's range.
    """
    if axis not in robot.axes:
        raise OutOfLimitsError(
            "axis {axis}: robot {name} has no such axis; use one of {axes}",
            axis=repr(axis),
            name=repr(robot.name),
            axes=", ".join(robot.axes),
        )
    if not is_finite(position):
        raise OutOfLimitsError(
            "axis {axis}: the target {position} is not a finite number",
            axis=AxisName(axis),
            position=repr(position),
        )
    model, unit = robot.axes[axis], robot.unit(axis) or ""
    low, high = model.range
    if _compute_excess(position, low, high) > RANGE_SLACK_RATIO * model.span:
        raise OutOfLimitsError(
            "axis {axis}: target {position} is outside its range {low} to "
            "{high}; choose a target inside",
            axis=AxisName(axis),
            position=format_exact(position, unit, size=high),
            low=format_exact(low, unit, size=high),
            high=format_exact(high, unit),
        )
    bounds = get_voltage_bounds(model)
    if bounds is None or not isinstance(model, PiezoAxis):
        return
    voltage = position / model.gain
    if _compute_excess(voltage, *bounds) > voltage_slack(bounds):
        raise OutOfLimitsError(
            "axis {axis}: target {position} needs {voltage} V, outside the "
            "amplifier's {low} V to {high} V; choose a target nearer to "
            "rest",
            axis=AxisName(axis),
            position=format_exact(position, unit),
            voltage=format_rounded(voltage, 6),
            low=format_rounded(bounds[0], 6),
            high=format_rounded(bounds[1], 6),
        )


def check_commands_fit_model(
    robot: Robot, record: Record, name: object, remedy: Message, first_row: int = 1
) -> None:
    """Refuse a record that cannot come from the machine that the model describes.

    Only commands count. A machine may overshoot its range, and its sensor may read a value outside,
    but it is never commanded far outside.

    Parameters
    ----------
    robot : Robot
    record : Record
    name : object
        Name of the record in messages.
    remedy : Message
        How the user can choose another model.
    first_row : int
        Number of the first row, if the record is a part of a longer one.

    Raises
    ------
    OutOfLimitsError
        If a command is outside the range by more than ``MAX_OUTSIDE_RANGE_RATIO`` of the travel.
    """
    for axis in record.axes:
        if axis not in robot.axes or not record.has(axis, Tap.CMD):
            continue
        command, model = record.signal(axis, Tap.CMD), robot.axes[axis]
        low, high = model.range
        excess = np.maximum(low - command, command - high)
        row = int(np.argmax(excess))
        slack = MAX_OUTSIDE_RANGE_RATIO * model.span
        if excess[row] <= slack:
            continue
        unit = record.units[axis]
        bound = low - slack if command[row] < low else high + slack
        raise OutOfLimitsError(
            "{name}: {axis}.cmd = {value} at row {row} is outside the range {low} to {high} of "
            "the model {model} by more than 5 % of the travel (bound {bound}). If this is a "
            "record of another machine, {remedy}; otherwise correct the unit in the record or "
            "the range in the robot file",
            name=str(name),
            axis=axis,
            value=format_exact(float(command[row]), unit, size=bound),
            row=first_row + row,
            low=format_exact(low, unit, size=high),
            high=format_exact(high, unit),
            model=robot.name,
            bound=format_exact(bound, unit, size=high),
            remedy=remedy,
        )


def get_voltage_bounds(axis: Axis) -> tuple[float, float] | None:
    """Return the limits of ``cmd/gain``, V, or None if there are none.

    Under a controller there are none, because the voltage is not ``cmd/gain`` and the controller
    clips it.
    """
    if not isinstance(axis, PiezoAxis) or axis.controller is not None:
        return None
    return axis.voltage_range


def compute_reachable_range(axis: Axis) -> tuple[float, float]:
    """Return the part of the range that the voltage of an axis' amplifier can reach, m or rad."""
    low, high = axis.range
    bounds = get_voltage_bounds(axis)
    if bounds is None or not isinstance(axis, PiezoAxis):
        return low, high
    voltage_ends = sorted(voltage * axis.gain for voltage in bounds)
    return max(low, voltage_ends[0]), min(high, voltage_ends[1])


def with_limits(
    robot: Robot,
    speeds: Mapping[str, float],
    accelerations: Mapping[str, float] = MappingProxyType({}),
) -> Robot:
    """Return a robot whose axes have these limits, or their existing limits if those are stricter.

    Parameters
    ----------
    robot : Robot
    speeds, accelerations : mapping axis -> float
        m/s or rad/s, and m/s² or rad/s², above 0. Other axes keep their limits.
    """
    axes = dict(robot.axes)
    for name, limit in speeds.items():
        axes[name] = replace(axes[name], max_speed=min(limit, axes[name].max_speed or inf))
    for name, limit in accelerations.items():
        axis = axes[name]
        axes[name] = replace(axis, max_acceleration=min(limit, axis.max_acceleration or inf))
    return replace(robot, axes=axes)


def get_command_resolution(axis: Axis) -> float:
    """Return the step to which commands may be rounded, m or rad: the sensor's resolution, or 0."""
    return axis.sensor.resolution if axis.sensor is not None else 0.0


def _compute_excess(value: float, low: float, high: float) -> float:
    return max(low - value, value - high)


def voltage_slack(bounds: tuple[float, float]) -> float:
    """Return the excess of these bounds, V, that is attributed to rounding."""
    return VOLTAGE_SLACK_RATIO * max(abs(bounds[0]), abs(bounds[1]))
