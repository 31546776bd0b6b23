"""Compensation in a session: inverses between what is wanted of piezo axes and what they are told.

A device that is a :class:`~rotemina.drivers.model_abilities.Compensator` sends every set-point
through the inverse at its own ticks: moves, speeds, profiles and trajectories alike. Any other is
told what the inverse makes of them: a trajectory's rows here, and the ends of moves, speeds and
profiles by :class:`~rotemina.app.motion.held_inverses.HeldInverses`.
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
from rotemina.sim.compensate.model import InverseModel
from rotemina.sim.compensate.trajectory import compensated, on_ticks
from rotemina.sim.messages import AxisName, message
from rotemina.sim.quantities import exact
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import PiezoAxis, Robot
from rotemina.sim.trajectory.checked import CheckedTrajectory, accepted
from rotemina.sim.trajectory.limits import OutOfLimitsError


@dataclass(frozen=True, slots=True, eq=False)
class NamedInverse:
    """An inverse with the robot that it was trained on, and what a record is to call it."""

    model: InverseModel
    robot: str
    name: str


class Inverses:
    """Inverses of axes, put on and taken off at rest."""

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
        """Whether the device asks the inverse at each of its ticks, not at ends and rows alone."""
        return isinstance(self._link.driver, Compensator)

    def exceedance(self, axis: str) -> Exceedance:
        """Return in what an axis has gone beyond its inverse since that was put on."""
        return self._in_use.get(axis, Exceedance(0))

    def apply(self, inverse: NamedInverse, *, permit: Permit | None = None) -> None:
        """Put an inverse on its axis, which stays where it is; no way leads back from there.

        Its command becomes the position that the inverse takes it to be at; what it went through
        before is not known, so that a constant error may stay until it has been through its range.

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
            self._admission.refuse_unless_at_rest("putting an inverse on")
            self._change(axis, inverse.model, permit)
            self._known = MappingProxyType({**self._known, axis: inverse})

    def remove(self, axis: str, *, permit: Permit | None = None) -> None:
        """Take the inverse off an axis; it stays where it is, and no way leads back from there.

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
            self._admission.refuse_unless_at_rest("taking an inverse off")
            self._change(axis, None, permit)

    def forget(self) -> None:
        """Have none on: another device is connected."""
        self._known = MappingProxyType({})

    @property
    def ends(self) -> Mapping[str, tuple[float, float]]:
        """Between which positions axes must stay that the device does not keep there by itself."""
        if self.live:
            return {}
        return {axis: one.model.desired_range for axis, one in self.applied.items()}

    def check(self, targets: Mapping[str, float]) -> None:
        """Refuse targets, m or rad, beyond what the inverse of their axis saw.

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
                        "axis {axis}: target {target} is beyond {low} to {high}, which its "
                        "inverse was trained on; stay inside, or switch the compensation off",
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
        """Return what is sent in place of a trajectory, if anything, and what inverses are called.

        What goes through the inverses is held against every limit too, before anything moves.

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
    """Refuse an inverse that is of another robot, or of no piezo axis of this one.

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
