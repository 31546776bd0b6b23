"""Compensation in a session: inverses that convert desired positions of piezo axes to commands.

A device that is a :class:`~rotemina.drivers.abilities.HysteresisCompensator` converts every
set-point with the inverse at its own ticks, for moves, speeds, profiles and trajectories alike.
Other devices receive commands that the host has converted. This module converts the rows of a
trajectory; ``held_inverses`` of the device converts the targets of moves, speeds, and the end
points of profiles.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.device import OPERATOR, DeviceLink, InverseCommand
from rotemina.app.motion.session.admission import RequestAdmission
from rotemina.drivers.abilities import HysteresisCompensator
from rotemina.drivers.contract import Permit
from rotemina.sim.compensate import (
    InverseExceedance,
    InverseModel,
    compensate_trajectory,
    sample_at_ticks,
)
from rotemina.sim.errors import CompensationError, OutOfLimitsError
from rotemina.sim.messages import AxisName
from rotemina.sim.records import Record
from rotemina.sim.robot import PiezoAxis, Robot
from rotemina.sim.trajectory import CheckedTrajectory, accept_trajectory
from rotemina.sim.units import format_exact


@dataclass(frozen=True, slots=True, eq=False)
class NamedInverse:
    """An inverse, the name of the robot it was trained for, and its own name in records."""

    model: InverseModel
    robot: str
    name: str


class AxisInverses:
    """Inverses of axes, applied and removed while the machine rests."""

    def __init__(self, link: DeviceLink, admission: RequestAdmission) -> None:
        self._link = link
        self._admission = admission
        self._named_inverses: Mapping[str, NamedInverse] = MappingProxyType({})

    @property
    def applied(self) -> Mapping[str, NamedInverse]:
        """The inverses in use, by axis. Any thread may read them."""
        # A cleared fault or a new connection removes an inverse from the device without this object
        # being notified, so the device is asked.
        inverses = self._named_inverses
        return {axis: inverses[axis] for axis in self._exceedances if axis in inverses}

    @property
    def is_applied_per_tick(self) -> bool:
        """Whether the device applies the inverse at each tick, not only at targets and rows."""
        return isinstance(self._link.driver, HysteresisCompensator)

    def find_exceedance(self, axis: str) -> InverseExceedance:
        """Return how an axis has left the training range of its inverse since it was applied."""
        return self._exceedances.get(axis, InverseExceedance(0))

    def apply(self, inverse: NamedInverse, *, permit: Permit | None = None) -> None:
        """Apply an inverse to its axis, which stays in place; undo cannot go back past this point.

        The command becomes the position that the inverse assumes for the axis. The history of the
        axis is unknown, so a constant error may remain until the axis has swept its range.

        Raises
        ------
        CompensationError
            If the inverse is for another robot, or for an axis that is not a piezo of this one.
        RequestRefusedError
            If the machine is not at rest, or for the same reasons as any move.
        """
        permit = self._admission.resolve_permit(permit)
        check_inverse_fits(self._link.robot, inverse)
        axis = inverse.model.axis
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("applying an inverse")
            self._queue_change(axis, inverse.model, permit)
            self._named_inverses = MappingProxyType({**self._named_inverses, axis: inverse})

    def remove(self, axis: str, *, permit: Permit | None = None) -> None:
        """Remove the inverse of an axis, which stays in place; undo cannot go back past this.

        Raises
        ------
        RequestRefusedError
            See :meth:`apply`. Also if the axis has no inverse.
        """
        permit = self._admission.resolve_permit(permit)
        if axis not in self.applied:
            raise RequestRefusedError("axis {axis} has no inverse to remove", axis=AxisName(axis))
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("removing an inverse")
            self._queue_change(axis, None, permit)

    def forget(self) -> None:
        """Forget all inverses when another device is connected."""
        self._named_inverses = MappingProxyType({})

    @property
    def position_limits(self) -> Mapping[str, tuple[float, float]]:
        """Position limits, m or rad, of axes whose device does not enforce the training range."""
        if self.is_applied_per_tick:
            return {}
        return {axis: inverse.model.desired_range for axis, inverse in self.applied.items()}

    def check_targets(self, targets: Mapping[str, float]) -> None:
        """Refuse targets, m or rad, outside the training range of the inverse of their axis.

        Raises
        ------
        OutOfLimitsError
            If a target is outside. The message gives the target and the bounds.
        """
        for axis, inverse in self.applied.items():
            low, high = inverse.model.desired_range
            slack = 1e-9 * inverse.model.span
            if axis in targets and not low - slack <= targets[axis] <= high + slack:
                unit = inverse.model.unit
                raise OutOfLimitsError(
                    "axis {axis}: target {target} is outside {low} to {high}, the "
                    "training range of its inverse; stay inside, or remove the inverse",
                    axis=AxisName(axis),
                    target=format_exact(targets[axis], unit),
                    low=format_exact(low, unit),
                    high=format_exact(high, unit),
                )

    def convert_trajectory(
        self, trajectory: CheckedTrajectory
    ) -> tuple[CheckedTrajectory | None, dict[str, str]]:
        """Return the commands to send in place of a trajectory, and the names of its inverses.

        The commands are None if the trajectory itself is sent.

        The converted commands are also checked against every limit before anything moves.

        Raises
        ------
        CompensationError, OutOfLimitsError
            See :func:`make_compensated_trajectory`.
        """
        axes = trajectory.commands.axes
        inverses = {axis: inverse for axis, inverse in self.applied.items() if axis in axes}
        names = {axis: inverse.name for axis, inverse in inverses.items()}
        if not inverses:
            return None, names
        commands, period_s = trajectory.commands, self._link.setpoint_period_s
        if self.is_applied_per_tick:
            commands = sample_at_ticks(commands, period_s)
        converted = make_compensated_trajectory(
            self._link.robot, commands, inverses, period_s, preview=not self.is_applied_per_tick
        )
        return (None if self.is_applied_per_tick else converted), names

    @property
    def _exceedances(self) -> Mapping[str, InverseExceedance]:
        driver = self._link.driver
        if isinstance(driver, HysteresisCompensator):
            return driver.compensated_axes
        return self._link.worker.inverses.exceedances

    def _queue_change(self, axis: str, model: InverseModel | None, permit: Permit) -> None:
        self._admission.queue(InverseCommand(axis, model), permit, (axis,), OPERATOR)
        self._admission.undo_history.forget()


def make_compensated_trajectory(
    robot: Robot,
    trajectory: Record,
    inverses: Mapping[str, NamedInverse],
    setpoint_period_s: float,
    *,
    preview: bool = True,
) -> CheckedTrajectory:
    """Return the commands that produce a trajectory, checked against the limits.

    Raises
    ------
    CompensationError, OutOfLimitsError
        If the trajectory leaves the training range of an inverse, or its commands exceed a limit.
    """
    named_models = {axis: (inverse.model, inverse.name) for axis, inverse in inverses.items()}
    try:
        converted = compensate_trajectory(robot, trajectory, named_models, preview=preview)
        return accept_trajectory(robot, converted, setpoint_period_s)
    except OutOfLimitsError as error:
        raise OutOfLimitsError(
            "compensated trajectory: {error}; the commands for the desired path exceed "
            "a limit: make it slower, smoother, or smaller",
            error=str(error),
        ) from error


def check_inverse_fits(robot: Robot, inverse: NamedInverse) -> None:
    """Refuse an inverse for another robot, or for an axis that is not a piezo of this one.

    Raises
    ------
    CompensationError
        If the inverse does not fit. The message names the robot or axis it was trained for.
    """
    axis = inverse.model.axis
    if inverse.robot != robot.name:
        raise CompensationError(
            "{name}: it was trained for robot {robot}, not for {this}; train one on this robot",
            name=inverse.name,
            robot=repr(inverse.robot),
            this=repr(robot.name),
        )
    axis_model = robot.axes.get(axis)
    if not isinstance(axis_model, PiezoAxis) or axis_model.controller is not None:
        raise CompensationError(
            "{name}: axis {axis} of robot {this} is not a piezo in open loop",
            name=inverse.name,
            axis=AxisName(axis),
            this=repr(robot.name),
        )
    if not axis_model.range[0] <= inverse.model.command_range[0] < axis_model.range[1]:
        raise CompensationError(
            "{name}: axis {axis} had another range; train the inverse again",
            name=inverse.name,
            axis=AxisName(axis),
        )
