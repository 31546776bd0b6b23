"""Ranges of axes that an operator narrowed: inside those of the robot file, never beyond them."""

from collections.abc import Iterable, Mapping
from math import sqrt
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from rotemina.sim.messages import AxisName, message
from rotemina.sim.quantities import exact
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.limits import RANGE_SLACK, OutOfLimitsError, check_target, commands_of

if TYPE_CHECKING:
    from rotemina.app.motion.admission import Admission
    from rotemina.app.motion.device_link import DeviceLink
    from rotemina.app.motion.guard import Guard

Range = tuple[float, float]
Ranges = Mapping[str, Range]
WHOLE: Ranges = MappingProxyType({})  # no axis is narrowed


class NarrowedRanges:
    """What the guard holds every target, speed, profile and trajectory against.

    A search for switches goes to the switches all the same.
    """

    def __init__(self, link: "DeviceLink", admission: "Admission", guard: "Guard") -> None:
        self._link = link
        self._admission = admission
        self._guard = guard

    @property
    def narrowed(self) -> Ranges:
        """The ranges of the axes that were narrowed, m or rad; any thread."""
        return self._guard.narrowed

    def of(self, axis: str) -> Range:
        """Return between which positions an axis may be sent, m or rad."""
        return self.narrowed.get(axis, self._link.robot.axes[axis].range)

    def narrow(self, axis: str, low: float, high: float) -> None:
        """Limit the targets of an axis to these positions, m or rad.

        Raises
        ------
        OutOfLimitsError
            If they are no range within that of the robot file, or the axis stands outside.
        RefusedError
            If the machine is not at rest, or motion is locked.
        """
        wanted = narrower(self._link.robot, axis, low, high)
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("narrowing a range")
            at = self._link.worker.state.command[axis]
            if _outside(self._link.robot, axis, at, wanted):
                unit = self._link.robot.unit(axis) or ""
                raise OutOfLimitsError(
                    message(
                        "engine",
                        "axis {axis} is at {at}, outside {low} to {high}; move it inside first",
                    ).fill(
                        axis=AxisName(axis),
                        at=exact(at, unit),
                        low=exact(low, unit),
                        high=exact(high, unit),
                    )
                )
            self._guard.narrowed = MappingProxyType({**self.narrowed, axis: wanted})

    def restore(self, axis: str) -> None:
        """Give an axis back the whole range of the robot file.

        Raises
        ------
        RefusedError
            If the machine is not at rest, or motion is locked.
        """
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("restoring a range")
            left = {name: ends for name, ends in self.narrowed.items() if name != axis}
            self._guard.narrowed = MappingProxyType(left)

    def begin_with(self, ranges: Ranges) -> None:
        """Use stored ranges, before the session is started.

        Raises
        ------
        OutOfLimitsError
            If one is none of this robot; then none is taken.
        """
        robot = self._link.robot
        taken = {axis: narrower(robot, axis, *ends) for axis, ends in ranges.items()}
        with self._admission.lock:
            self._guard.narrowed = MappingProxyType(taken)


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
            message(
                "engine", "axis {axis}: a range from {low} to {high}: its low end must be lower"
            ).fill(axis=AxisName(axis), low=exact(low, unit), high=exact(high, unit))
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
        if ends is None or not _outside(robot, axis, target, ends):
            continue
        unit = robot.unit(axis) or ""
        raise OutOfLimitsError(
            message(
                "engine",
                "axis {axis}: target {target} is outside of {low} to {high}, to which its range "
                "was narrowed; choose a target inside, or widen it in Control, Axes",
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


def _outside(robot: Robot, axis: str, position: float, ends: Range) -> bool:
    slack = RANGE_SLACK * robot.axes[axis].span
    return not ends[0] - slack <= position <= ends[1] + slack
