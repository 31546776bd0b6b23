"""One-sided approach of stepper axes, so that backlash is always on the same side.

Where an axis would come from the wrong side, or has not gone far enough to take up the play, it
first goes beyond its target by ``width``. That way passes every check, as any move does. It is made
for single targets that begin at rest; at a speed, or in a trajectory, it would be a leap.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from rotemina.app.motion.admission import Admission
from rotemina.app.motion.device_link import DeviceLink
from rotemina.app.motion.narrowed_ranges import NarrowedRanges
from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.backlash import BACKLASH
from rotemina.sim.messages import AxisName, message
from rotemina.sim.quantities import exact
from rotemina.sim.robot.model import AxisEffect, Robot, StepperAxis
from rotemina.sim.trajectory.axis_limits import RANGE_SLACK, OutOfLimitsError, resolution_of

MOST_SHARE = 0.01  # of an axis' range, that a width may be
OVER_PLAY = 1.5  # of a play that was measured: the width that surely takes it up


def play_of(robot: Robot, effects: Iterable[AxisEffect], axis: str) -> float | None:
    """Return the backlash of an axis from diagnosed effects, m, or None."""
    own = (one for one in effects if one.enabled and one.axis == axis and one.id == BACKLASH.id)
    plays = [Attached.of(robot, one).values.get("width", 0.0) for one in own]
    return sum(plays) if plays else None


@dataclass(frozen=True, slots=True)
class Approach:
    """The approach of an axis to targets: ``rising`` or falling, over ``width`` (m) or more."""

    width: float
    rising: bool


class Backlash:
    """One-sided approaches of axes, each off until someone chooses it.

    Attributes
    ----------
    applied : mapping axis -> Approach
        Replaced as a whole; any thread.
    """

    def __init__(self, link: DeviceLink, admission: Admission, ranges: NarrowedRanges) -> None:
        self._link = link
        self._admission = admission
        self._ranges = ranges
        self.applied: Mapping[str, Approach] = MappingProxyType({})

    def use(self, axis: str, approach: Approach | None) -> None:
        """Set the approach of an axis from now on; None: straight.

        Raises
        ------
        OutOfLimitsError
            If it is no stepper axis of this robot, or the width is beyond a bound.
        RefusedError
            If the machine is not at rest, or motion is locked.
        """
        described = self._link.robot.axes.get(axis)
        if not isinstance(described, StepperAxis):
            raise OutOfLimitsError(
                message(
                    "engine", "axis {axis} is not a stepper axis; only these have backlash"
                ).fill(axis=AxisName(axis))
            )
        most = MOST_SHARE * described.span
        if approach is not None and not 0.0 < approach.width <= most:
            unit = described.unit or "m"
            raise OutOfLimitsError(
                message(
                    "engine",
                    "axis {axis}: width {width}: must be above 0 and at most {most}, a "
                    "hundredth of the range",
                ).fill(
                    axis=AxisName(axis),
                    width=exact(approach.width, unit),
                    most=exact(most, unit),
                )
            )
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("changing the approach of an axis")
            kept = {name: one for name, one in self.applied.items() if name != axis}
            if approach is not None:
                kept[axis] = approach
            self.applied = MappingProxyType(kept)
            self._admission.note_approached({}, (axis,))

    def forget(self) -> None:
        """Have none: another device is connected."""
        self.applied = MappingProxyType({})

    def taken_up(self, axis: str) -> bool:
        """Return whether an axis is where its one-sided approach ended."""
        at = self._admission.approached.get(axis)
        command = self._link.worker.state.command.get(axis)
        if at is None or command is None:
            return False
        return abs(command - at) <= max(
            resolution_of(self._link.robot.axes[axis]), self._slack(axis)
        )

    def ways(self, ways: Sequence[Mapping[str, float]]) -> list[Mapping[str, float]]:
        """Return ways (targets, m, one after the other from rest) with the approaches in them.

        Raises
        ------
        OutOfLimitsError
            If an approach would begin beyond the range.
        """
        if not self.applied:
            return list(ways)
        last = {axis: number for number, way in enumerate(ways) for axis in way}
        reached, moved = dict(self._link.worker.state.command), set[str]()
        found: list[Mapping[str, float]] = []
        for number, way in enumerate(ways):
            begins = {}
            for axis in self.applied.keys() & way.keys():
                taken_up = axis not in moved and self.taken_up(axis)
                if last[axis] == number and not self._straight(
                    axis, way[axis] - reached[axis], taken_up=taken_up
                ):
                    begins[axis] = self._beginning(axis, way[axis])
            if begins:
                found.append({**way, **begins})
            found.append({axis: way[axis] for axis in begins} or way)
            reached |= way
            moved |= way.keys()
        return found

    def _straight(self, axis: str, way: float, *, taken_up: bool) -> bool:
        """Whether an axis that goes so far comes from its side, with the play taken up."""
        approach = self.applied[axis]
        forth = way if approach.rising else -way
        return forth >= approach.width or (taken_up and forth >= 0.0)

    def _beginning(self, axis: str, target: float) -> float:
        approach, (low, high) = self.applied[axis], self._ranges.of(axis)
        begin = target - approach.width if approach.rising else target + approach.width
        if low - self._slack(axis) <= begin <= high + self._slack(axis):
            return begin
        unit = self._link.robot.unit(axis) or "m"
        raise OutOfLimitsError(
            message(
                "engine",
                "axis {axis}: the one-sided approach to {target} begins at {begin}, outside "
                "{low} to {high}; stay {width} away from that end, or switch the approach off",
            ).fill(
                axis=AxisName(axis),
                target=exact(target, unit),
                begin=exact(begin, unit),
                low=exact(low, unit),
                high=exact(high, unit),
                width=exact(approach.width, unit),
            )
        )

    def _slack(self, axis: str) -> float:
        return RANGE_SLACK * self._link.robot.axes[axis].span
