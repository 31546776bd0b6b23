"""Axis ranges that an operator has narrowed, always within those of the robot file."""

from collections.abc import Iterable, Mapping
from math import sqrt
from types import MappingProxyType

import numpy as np

from rotemina.sim.errors import OutOfLimitsError
from rotemina.sim.messages import AxisName
from rotemina.sim.records import Record
from rotemina.sim.robot import Robot
from rotemina.sim.trajectory import RANGE_SLACK_RATIO, check_target, commands_of
from rotemina.sim.units import format_exact

Range = tuple[float, float]
Ranges = Mapping[str, Range]
NO_NARROWED_RANGES: Ranges = MappingProxyType({})


def check_narrower_range(robot: Robot, axis: str, low: float, high: float) -> Range:
    """Return the range from ``low`` to ``high`` if an axis may be narrowed to it.

    Raises
    ------
    OutOfLimitsError
        If the axis does not exist, an end is outside the range of the robot file, or ``low`` is not
        below ``high``.
    """
    for end in (low, high):
        check_target(robot, axis, end)
    if not low < high:
        unit = robot.unit(axis) or ""
        raise OutOfLimitsError(
            "axis {axis}: range {low} to {high}: the low end must be lower",
            axis=AxisName(axis),
            low=format_exact(low, unit),
            high=format_exact(high, unit),
        )
    return low, high


def check_within(robot: Robot, ranges: Ranges, targets: Iterable[tuple[str, float]]) -> None:
    """Refuse targets, m or rad, that are outside a narrowed range.

    Raises
    ------
    OutOfLimitsError
        If a target is outside. The message gives the target and the bounds.
    """
    for axis, target in targets:
        ends = ranges.get(axis)
        if ends is None or not is_outside(robot, axis, target, ends):
            continue
        unit = robot.unit(axis) or ""
        raise OutOfLimitsError(
            "axis {axis}: target {target} is outside {low} to {high}, its narrowed "
            "range; choose a target inside, or widen the range in Control, Axes",
            axis=AxisName(axis),
            target=format_exact(target, unit),
            low=format_exact(ends[0], unit),
            high=format_exact(ends[1], unit),
        )


def check_rows(robot: Robot, ranges: Ranges, commands: Record) -> None:
    """Refuse a trajectory that leaves a narrowed range.

    Raises
    ------
    OutOfLimitsError
        See :func:`check_within`.
    """
    if not ranges:
        return
    for axis, signal in commands_of(robot, commands).items():
        check_within(robot, ranges, ((axis, float(end)) for end in (signal.min(), signal.max())))


def intersect_ranges(*range_sets: Ranges) -> dict[str, Range]:
    """Return the intersection of several sets of ranges."""
    intersection: dict[str, Range] = {}
    for ranges in range_sets:
        for axis, (low, high) in ranges.items():
            common_range = intersection.get(axis, (-np.inf, np.inf))
            intersection[axis] = max(common_range[0], low), min(common_range[1], high)
    return intersection


def compute_stoppable_speed(distance: float, time_s: float, deceleration: float | None) -> float:
    """Return the highest speed from which an axis can stop within a distance, m or rad.

    The axis moves at this speed for ``time_s``, and then brakes at ``deceleration``, m/s² or
    rad/s². None or 0 means that it stops at once.
    """
    distance = max(distance, 0.0)
    if not deceleration:
        return distance / time_s
    # This solves v · time_s + v² / (2 · deceleration) = distance for the speed v.
    speed_loss = deceleration * time_s
    return sqrt(speed_loss**2 + 2.0 * deceleration * distance) - speed_loss


def is_outside(robot: Robot, axis: str, position: float, ends: Range) -> bool:
    """Return whether a position, m or rad, is outside a range by more than rounding errors."""
    slack = RANGE_SLACK_RATIO * robot.axes[axis].span
    return not ends[0] - slack <= position <= ends[1] + slack
