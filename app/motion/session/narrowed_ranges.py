"""Requests of an operator to narrow the ranges of axes, and to restore them."""

from types import MappingProxyType

from rotemina.app.motion.device import DeviceLink
from rotemina.app.motion.limits import (
    Guard,
    Range,
    Ranges,
    check_narrower_range,
    is_outside,
)
from rotemina.app.motion.session.admission import RequestAdmission
from rotemina.sim.errors import OutOfLimitsError
from rotemina.sim.messages import AxisName
from rotemina.sim.units import format_exact


class NarrowedRanges:
    """Ranges that the operator has narrowed; they limit targets, speeds, profiles and trajectories.

    A search for limit switches ignores them.
    """

    def __init__(self, link: DeviceLink, admission: RequestAdmission, guard: Guard) -> None:
        self._link = link
        self._admission = admission
        self._guard = guard

    @property
    def narrowed_ranges(self) -> Ranges:
        """The ranges of the narrowed axes, m or rad; may be read from any thread."""
        return self._guard.narrowed_ranges

    def find_range(self, axis: str) -> Range:
        """Return the lowest and the highest target that an axis may have, m or rad."""
        return self.narrowed_ranges.get(axis, self._link.robot.axes[axis].range)

    def narrow(self, axis: str, low: float, high: float) -> None:
        """Limit the targets of an axis to these positions, m or rad.

        Raises
        ------
        OutOfLimitsError
            If they do not form a range inside that of the robot file, or the axis is outside now.
        RequestRefusedError
            If the machine is not at rest, or motion is locked.
        """
        ends = check_narrower_range(self._link.robot, axis, low, high)
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("narrowing a range")
            position = self._link.worker.state.command[axis]
            if is_outside(self._link.robot, axis, position, ends):
                unit = self._link.robot.unit(axis) or ""
                raise OutOfLimitsError(
                    "axis {axis} is at {at}, outside {low} to {high}; move it inside first",
                    axis=AxisName(axis),
                    at=format_exact(position, unit),
                    low=format_exact(low, unit),
                    high=format_exact(high, unit),
                )
            self._guard.narrowed_ranges = MappingProxyType({**self.narrowed_ranges, axis: ends})

    def restore(self, axis: str) -> None:
        """Restore the full range of an axis, as the robot file gives it.

        Raises
        ------
        RequestRefusedError
            If the machine is not at rest, or motion is locked.
        """
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("restoring a range")
            remaining_ranges = {
                name: ends for name, ends in self.narrowed_ranges.items() if name != axis
            }
            self._guard.narrowed_ranges = MappingProxyType(remaining_ranges)

    def set_initial_ranges(self, ranges: Ranges) -> None:
        """Set the stored ranges before the session is started.

        Raises
        ------
        OutOfLimitsError
            If a range does not fit this robot; then none is set.
        """
        robot = self._link.robot
        narrowed = {axis: check_narrower_range(robot, axis, *ends) for axis, ends in ranges.items()}
        with self._admission.lock:
            self._guard.narrowed_ranges = MappingProxyType(narrowed)
