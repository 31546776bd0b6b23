"""Narrowing and restoring of axis ranges by an operator."""

from types import MappingProxyType

from rotemina.app.motion.admission import Admission
from rotemina.app.motion.device_link import DeviceLink
from rotemina.app.motion.guard import Guard
from rotemina.app.motion.ranges import Range, Ranges, narrower, outside
from rotemina.sim.messages import AxisName, message
from rotemina.sim.quantities import exact
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError


class NarrowedRanges:
    """What the guard holds every target, speed, profile and trajectory against.

    A search for switches goes to the switches all the same.
    """

    def __init__(self, link: DeviceLink, admission: Admission, guard: Guard) -> None:
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
            if outside(self._link.robot, axis, at, wanted):
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
