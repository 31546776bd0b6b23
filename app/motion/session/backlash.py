"""One-sided approach of stepper axes, so that backlash is always on the same side.

An axis that would arrive from the wrong side, or that would not move far enough to take up the
play, makes a detour: it first moves to a point ``width`` away from its target, on the right side.
The detour passes the same checks as any other move. It is made only for moves to targets that start
at rest. During a move at a set speed, or in a trajectory, it would be a jump.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from rotemina.app.motion.device import DeviceLink
from rotemina.app.motion.session.admission import RequestAdmission
from rotemina.app.motion.session.narrowed_ranges import NarrowedRanges
from rotemina.sim.effects import BACKLASH, AttachedEffect
from rotemina.sim.errors import OutOfLimitsError
from rotemina.sim.messages import AxisName
from rotemina.sim.robot import (
    AxisEffect,
    Robot,
    StepperAxis,
)
from rotemina.sim.trajectory import RANGE_SLACK_RATIO, get_command_resolution
from rotemina.sim.units import format_exact

# Largest width of an approach, as a fraction of the axis' range.
MAX_WIDTH_RATIO = 0.01
# Width that reliably takes up a measured play, as a multiple of that play.
WIDTH_TO_PLAY_RATIO = 1.5


def find_measured_backlash(robot: Robot, effects: Iterable[AxisEffect], axis: str) -> float | None:
    """Return the backlash of an axis from diagnosed effects, m, or None if there is none."""
    matches = (
        effect
        for effect in effects
        if effect.enabled and effect.axis == axis and effect.id == BACKLASH.id
    )
    plays = [AttachedEffect.of(robot, effect).values.get("width", 0.0) for effect in matches]
    return sum(plays) if plays else None


@dataclass(frozen=True, slots=True)
class OneSidedApproach:
    """How an axis approaches targets: ``rising`` or falling, over at least ``width`` (m)."""

    width: float
    rising: bool


class BacklashCompensation:
    """One-sided approaches of axes, each off until the operator chooses it.

    Attributes
    ----------
    applied : mapping axis -> OneSidedApproach
        The approach of each axis that has one. Replaced as a whole, so any thread may read it.
    """

    def __init__(
        self, link: DeviceLink, admission: RequestAdmission, ranges: NarrowedRanges
    ) -> None:
        self._link = link
        self._admission = admission
        self._ranges = ranges
        self.applied: Mapping[str, OneSidedApproach] = MappingProxyType({})

    def set_approach(self, axis: str, approach: OneSidedApproach | None) -> None:
        """Set the approach of an axis from now on; with None it moves straight to its targets.

        Raises
        ------
        OutOfLimitsError
            If the axis is not a stepper axis of this robot, or the width is out of bounds.
        RequestRefusedError
            If the machine is not at rest, or motion is locked.
        """
        axis_model = self._link.robot.axes.get(axis)
        if not isinstance(axis_model, StepperAxis):
            raise OutOfLimitsError(
                "axis {axis} is not a stepper axis; only these have backlash", axis=AxisName(axis)
            )
        max_width = MAX_WIDTH_RATIO * axis_model.span
        if approach is not None and not 0.0 < approach.width <= max_width:
            unit = axis_model.unit or "m"
            raise OutOfLimitsError(
                "axis {axis}: the width {width} must be above 0 and at most {most}, a "
                "hundredth of the range",
                axis=AxisName(axis),
                width=format_exact(approach.width, unit),
                most=format_exact(max_width, unit),
            )
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("changing the approach of an axis")
            approaches = {name: other for name, other in self.applied.items() if name != axis}
            if approach is not None:
                approaches[axis] = approach
            self.applied = MappingProxyType(approaches)
            self._admission.note_approached_targets({}, (axis,))

    def clear(self) -> None:
        """Remove all approaches when another device is connected."""
        self.applied = MappingProxyType({})

    def is_taken_up(self, axis: str) -> bool:
        """Return whether an axis is still where its one-sided approach ended."""
        target = self._admission.one_sided_targets.get(axis)
        command = self._link.worker.state.command.get(axis)
        if target is None or command is None:
            return False
        return abs(command - target) <= max(
            get_command_resolution(self._link.robot.axes[axis]), self._compute_slack(axis)
        )

    def add_approaches(self, waypoints: Sequence[Mapping[str, float]]) -> list[Mapping[str, float]]:
        """Return the waypoints of a move that starts at rest, with one-sided approaches added.

        Each waypoint holds targets, m, in the order of visit.

        Raises
        ------
        OutOfLimitsError
            If an approach would begin beyond the range.
        """
        if not self.applied:
            return list(waypoints)
        last_visits = {axis: index for index, targets in enumerate(waypoints) for axis in targets}
        position, moved_axes = dict(self._link.worker.state.command), set[str]()
        path: list[Mapping[str, float]] = []
        for index, targets in enumerate(waypoints):
            approach_starts = {}
            for axis in self.applied.keys() & targets.keys():
                is_taken_up = axis not in moved_axes and self.is_taken_up(axis)
                # Only the last target of an axis is approached; it passes through the earlier ones.
                if last_visits[axis] == index and not self._can_go_straight(
                    axis, targets[axis] - position[axis], is_taken_up=is_taken_up
                ):
                    approach_starts[axis] = self._find_approach_start(axis, targets[axis])
            # First move to the starts of the approaches, then only those axes to their targets.
            if approach_starts:
                path.append({**targets, **approach_starts})
            path.append({axis: targets[axis] for axis in approach_starts} or targets)
            position |= targets
            moved_axes |= targets.keys()
        return path

    def _can_go_straight(self, axis: str, distance: float, *, is_taken_up: bool) -> bool:
        """Return whether a move by ``distance`` arrives from the right side with play taken up."""
        approach = self.applied[axis]
        forward = distance if approach.rising else -distance
        return forward >= approach.width or (is_taken_up and forward >= 0.0)

    def _find_approach_start(self, axis: str, target: float) -> float:
        approach, (low, high) = self.applied[axis], self._ranges.find_range(axis)
        start = target - approach.width if approach.rising else target + approach.width
        if low - self._compute_slack(axis) <= start <= high + self._compute_slack(axis):
            return start
        unit = self._link.robot.unit(axis) or "m"
        raise OutOfLimitsError(
            "axis {axis}: the one-sided approach to {target} begins at {begin}, outside "
            "{low} to {high}; stay {width} away from that end, or switch the approach off",
            axis=AxisName(axis),
            target=format_exact(target, unit),
            begin=format_exact(start, unit),
            low=format_exact(low, unit),
            high=format_exact(high, unit),
            width=format_exact(approach.width, unit),
        )

    def _compute_slack(self, axis: str) -> float:
        return RANGE_SLACK_RATIO * self._link.robot.axes[axis].span
