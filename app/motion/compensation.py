"""Compensation in a session: inverses that convert desired positions of piezo axes to commands.

A device that is a :class:`~rotemina.drivers.model_abilities.Compensator` sends every set-point
through the inverse at its own ticks: moves, speeds, profiles and trajectories alike. Other devices
get converted commands: rows of a trajectory from here, ends of moves, speeds and profiles from
:class:`~rotemina.app.motion.held_inverses.HeldInverses`.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from rotemina.app.motion.admission import Admission
from rotemina.app.motion.device_link import DeviceLink
from rotemina.app.motion.mailbox import Compensate, RefusedError
from rotemina.app.motion.ownership import OPERATOR
from rotemina.drivers.gate import Permit
from rotemina.drivers.model_abilities import Compensator
from rotemina.sim.compensate.errors import CompensationError
from rotemina.sim.compensate.inverse import Exceedance
from rotemina.sim.compensate.inverse_parameters import InverseModel
from rotemina.sim.compensate.trajectory import compensated, on_ticks
from rotemina.sim.messages import AxisName, message
from rotemina.sim.quantities import exact
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import PiezoAxis, Robot
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError
from rotemina.sim.trajectory.checked_trajectory import CheckedTrajectory, accepted


@dataclass(frozen=True, slots=True, eq=False)
class NamedInverse:
    """An inverse with the robot of its training, and its name in records."""

    model: InverseModel
    robot: str
    name: str


class Inverses:
    """Inverses of axes, applied and removed at rest."""

    def __init__(self, link: DeviceLink, admission: Admission) -> None:
        self._link = link
        self._admission = admission
        self._known: Mapping[str, NamedInverse] = MappingProxyType({})

    @property
    def applied(self) -> Mapping[str, NamedInverse]:
        """The inverses that are on, by axis; any thread."""
        # A cleared fault or a new connection ends it there.
        known = self._known
        return {axis: known[axis] for axis in self._in_use if axis in known}

    @property
    def live(self) -> bool:
        """Whether the device applies the inverse at each tick, not only at ends and rows."""
        return isinstance(self._link.driver, Compensator)

    def exceedance(self, axis: str) -> Exceedance:
        """Return how an axis has exceeded its inverse since that was applied."""
        return self._in_use.get(axis, Exceedance(0))

    def apply(self, inverse: NamedInverse, *, permit: Permit | None = None) -> None:
        """Apply an inverse to its axis, which stays in place; undo cannot cross this point.

        The command becomes the position that the inverse assumes. The history of the axis is
        unknown, so a constant error may remain until the axis has swept its range.

        Raises
        ------
        CompensationError
            If the inverse is of another robot, or of none of its piezo axes.
        RefusedError
            If the machine is not at rest, or as for any move.
        """
        permit = self._admission.drawn(permit)
        check_belongs(self._link.robot, inverse)
        axis = inverse.model.axis
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("applying an inverse")
            self._change(axis, inverse.model, permit)
            self._known = MappingProxyType({**self._known, axis: inverse})

    def remove(self, axis: str, *, permit: Permit | None = None) -> None:
        """Remove the inverse of an axis, which stays in place; undo cannot cross this point.

        Raises
        ------
        RefusedError
            As :meth:`apply`, or if there is none on.
        """
        permit = self._admission.drawn(permit)
        if axis not in self.applied:
            raise RefusedError(
                message("engine", "axis {axis} has no inverse to remove").fill(axis=AxisName(axis))
            )
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("removing an inverse")
            self._change(axis, None, permit)

    def forget(self) -> None:
        """Have none on: another device is connected."""
        self._known = MappingProxyType({})

    @property
    def ends(self) -> Mapping[str, tuple[float, float]]:
        """Positions that limit axes whose device does not enforce the range of the inverse."""
        if self.live:
            return {}
        return {axis: one.model.desired_range for axis, one in self.applied.items()}

    def check(self, targets: Mapping[str, float]) -> None:
        """Refuse targets, m or rad, outside the training range of the inverse of their axis.

        Raises
        ------
        OutOfLimitsError
            With the target and the bounds.
        """
        for axis, inverse in self.applied.items():
            low, high = inverse.model.desired_range
            slack = 1e-9 * inverse.model.span
            if axis in targets and not low - slack <= targets[axis] <= high + slack:
                unit = inverse.model.unit
                raise OutOfLimitsError(
                    message(
                        "engine",
                        "axis {axis}: target {target} is outside {low} to {high}, the "
                        "training range of its inverse; stay inside, or remove the inverse",
                    ).fill(
                        axis=AxisName(axis),
                        target=exact(targets[axis], unit),
                        low=exact(low, unit),
                        high=exact(high, unit),
                    )
                )

    def sent(
        self, trajectory: CheckedTrajectory
    ) -> tuple[CheckedTrajectory | None, dict[str, str]]:
        """Return the commands sent in place of a trajectory, if any, and the names of the inverses.

        Converted commands are also checked against every limit, before anything moves.

        Raises
        ------
        CompensationError, OutOfLimitsError
            As :func:`compensated_trajectory`.
        """
        commanded = trajectory.commands.axes
        used = {axis: one for axis, one in self.applied.items() if axis in commanded}
        names = {axis: one.name for axis, one in used.items()}
        if not used:
            return None, names
        commands, period_s = trajectory.commands, self._link.setpoint_period_s
        if self.live:
            commands = on_ticks(commands, period_s)
        sent = compensated_trajectory(
            self._link.robot, commands, used, period_s, preview=not self.live
        )
        return (None if self.live else sent), names

    @property
    def _in_use(self) -> Mapping[str, Exceedance]:
        driver = self._link.driver
        if isinstance(driver, Compensator):
            return driver.compensated
        return self._link.worker.inverses.beyond

    def _change(self, axis: str, model: InverseModel | None, permit: Permit) -> None:
        self._admission.queue(Compensate(axis, model), permit, (axis,), OPERATOR)
        self._admission.way_back.forget()


def compensated_trajectory(
    robot: Robot,
    trajectory: Record,
    inverses: Mapping[str, NamedInverse],
    setpoint_period_s: float,
    *,
    preview: bool = True,
) -> CheckedTrajectory:
    """Return a trajectory with the inverses' commands, checked against the limits.

    Raises
    ------
    CompensationError, OutOfLimitsError
        If it goes beyond what an inverse saw, or what that asks for is beyond a limit.
    """
    models = {axis: (one.model, one.name) for axis, one in inverses.items()}
    try:
        sent = compensated(robot, trajectory, models, preview=preview)
        return accepted(robot, sent, setpoint_period_s)
    except OutOfLimitsError as error:
        raise OutOfLimitsError(
            message(
                "engine",
                "compensated trajectory: {error}; the commands for the desired path exceed "
                "a limit: make it slower, smoother, or smaller",
            ).fill(error=str(error))
        ) from error


def check_belongs(robot: Robot, inverse: NamedInverse) -> None:
    """Refuse an inverse of another robot, or of an axis that is not a piezo of this one.

    Raises
    ------
    CompensationError
        With what it is of.
    """
    axis = inverse.model.axis
    if inverse.robot != robot.name:
        raise CompensationError(
            message(
                "engine",
                "{name}: it was trained for robot {robot}, not for {this}; train one on this robot",
            ).fill(name=inverse.name, robot=repr(inverse.robot), this=repr(robot.name))
        )
    described = robot.axes.get(axis)
    if not isinstance(described, PiezoAxis) or described.controller is not None:
        raise CompensationError(
            message(
                "engine", "{name}: axis {axis} of robot {this} is not a piezo in open loop"
            ).fill(name=inverse.name, axis=AxisName(axis), this=repr(robot.name))
        )
    if not described.range[0] <= inverse.model.command_range[0] < described.range[1]:
        raise CompensationError(
            message(
                "engine", "{name}: axis {axis} had another range; train the inverse again"
            ).fill(name=inverse.name, axis=AxisName(axis))
        )
