"""Axis ranges narrowed by an operator, always inside those of the robot file."""

from collections.abc import Iterable, Mapping
from math import sqrt
from types import MappingProxyType

import numpy as np

from rotemina.sim.messages import AxisName, message
from rotemina.sim.quantities import exact
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.axis_limits import RANGE_SLACK, OutOfLimitsError, check_target
from rotemina.sim.trajectory.trajectory_excesses import commands_of

Range = tuple[float, float]
Ranges = Mapping[str, Range]
WHOLE: Ranges = MappingProxyType({})  # no axis is narrowed


def narrower(robot: Robot, axis: str, low: float, high: float) -> Range:
    """Return a range that an axis may be narrowed to.

    Raises
    ------
    OutOfLimitsError
        If there is no such axis, an end is beyond the robot file's range, or low is not below high.
    """
    for end in (low, high):
        check_target(robot, axis, end)
    if not low < high:
        unit = robot.unit(axis) or ""
        raise OutOfLimitsError(
            message("engine", "axis {axis}: range {low} to {high}: the low end must be lower").fill(
                axis=AxisName(axis), low=exact(low, unit), high=exact(high, unit)
            )
        )
    return low, high


def check_within(robot: Robot, ranges: Ranges, targets: Iterable[tuple[str, float]]) -> None:
    """Refuse targets, m or rad, that are outside of a narrowed range.

    Raises
    ------
    OutOfLimitsError
        With the target and the bounds.
    """
    for axis, target in targets:
        ends = ranges.get(axis)
        if ends is None or not outside(robot, axis, target, ends):
            continue
        unit = robot.unit(axis) or ""
        raise OutOfLimitsError(
            message(
                "engine",
                "axis {axis}: target {target} is outside {low} to {high}, its narrowed "
                "range; choose a target inside, or widen the range in Control, Axes",
            ).fill(
                axis=AxisName(axis),
                target=exact(target, unit),
                low=exact(ends[0], unit),
                high=exact(ends[1], unit),
            )
        )


def check_rows(robot: Robot, ranges: Ranges, commands: Record) -> None:
    """Refuse a trajectory that leaves a narrowed range.

    Raises
    ------
    OutOfLimitsError
        As :func:`check_within`.
    """
    if not ranges:
        return
    for axis, signal in commands_of(robot, commands).items():
        check_within(robot, ranges, ((axis, float(end)) for end in (signal.min(), signal.max())))


def within(*each: Ranges) -> dict[str, Range]:
    """Return the ranges that all of these allow."""
    found: dict[str, Range] = {}
    for ranges in each:
        for axis, (low, high) in ranges.items():
            before = found.get(axis, (-np.inf, np.inf))
            found[axis] = max(before[0], low), min(before[1], high)
    return found


def speed_before(left: float, time_s: float, braking: float | None) -> float:
    """Return the speed that goes ``left`` (m or rad) in ``time_s`` and the braking after it."""
    left = max(left, 0.0)
    if not braking:
        return left / time_s
    lost = braking * time_s  # most · time_s + most² / (2 braking) = left
    return sqrt(lost**2 + 2.0 * braking * left) - lost


def outside(robot: Robot, axis: str, position: float, ends: Range) -> bool:
    """Return whether a position, m or rad, is beyond these ends by more than rounding."""
    slack = RANGE_SLACK * robot.axes[axis].span
    return not ends[0] - slack <= position <= ends[1] + slack
