"""Compensation in a session: inverses between what is wanted of piezo axes and what they are told.

A device that is a :class:`~rotemina.drivers.model_abilities.Compensator` sends every set-point
through the inverse at its own ticks: moves, speeds, profiles and trajectories alike. To any other,
a trajectory is handed over with the inverse's commands in it, and single moves go as they are told.
"""

from abc import ABC
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from rotemina.app.motion.device_requests import DeviceRequests
from rotemina.app.motion.mailbox import Compensate, RefusedError
from rotemina.app.motion.ownership import OPERATOR
from rotemina.drivers.driver import Driver
from rotemina.drivers.gate import Permit
from rotemina.drivers.model_abilities import Compensator
from rotemina.sim.compensate.errors import CompensationError
from rotemina.sim.compensate.inverse import Exceedance
from rotemina.sim.compensate.model import InverseModel
from rotemina.sim.compensate.trajectory import compensated, on_ticks
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import PiezoAxis, Robot
from rotemina.sim.trajectory.checked import CheckedTrajectory, accepted
from rotemina.sim.trajectory.limits import OutOfLimitsError
from rotemina.sim.trajectory.wording import readable


@dataclass(frozen=True, slots=True, eq=False)
class NamedInverse:
    """An inverse with the robot that it was trained on, and what a record is to call it."""

    model: InverseModel
    robot: str
    name: str


class CompensatedRequests(DeviceRequests, ABC):
    """Inverses of axes, put on and taken off at rest.

    Parameters are those of :class:`~rotemina.app.motion.device_session.DeviceSession`.
    """

    def __init__(self, driver: Driver, **options: Any) -> None:
        super().__init__(driver, **options)
        self._inverses: Mapping[str, NamedInverse] = MappingProxyType({})

    @property
    def compensated(self) -> Mapping[str, NamedInverse]:
        """The inverses that are on, by axis; any thread."""
        known = self._inverses
        if not self.compensates_all:
            return known
        # The device says: a cleared fault or a new connection ends it there.
        return {axis: known[axis] for axis in self._on_device if axis in known}

    @property
    def compensates_all(self) -> bool:
        """Whether every command goes through the inverse, not only those of trajectories."""
        return isinstance(self.driver, Compensator)

    def beyond_inverse(self, axis: str) -> Exceedance:
        """Return in what an axis has gone beyond its inverse since that was put on."""
        return self._on_device.get(axis, Exceedance(0))

    def compensate(self, inverse: NamedInverse, *, permit: Permit | None = None) -> None:
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
        permit = self._drawn(permit)
        check_belongs(self.robot, inverse)
        axis = inverse.model.axis
        with self._lock:
            self._refuse_unless_at_rest("putting an inverse on")
            self._change(axis, inverse.model, permit)
            self._inverses = MappingProxyType({**self._inverses, axis: inverse})
            self._forget_way_back()

    def uncompensate(self, axis: str, *, permit: Permit | None = None) -> None:
        """Take the inverse off an axis; it stays where it is, and no way leads back from there.

        Raises
        ------
        RefusedError
            As :meth:`compensate`, or if there is none on.
        """
        permit = self._drawn(permit)
        if axis not in self.compensated:
            raise RefusedError(f"axis {axis} has no inverse that could be taken off")
        with self._lock:
            self._refuse_unless_at_rest("taking an inverse off")
            self._change(axis, None, permit)
            self._forget_way_back()
            if not self.compensates_all:
                left = {key: one for key, one in self._inverses.items() if key != axis}
                self._inverses = MappingProxyType(left)

    def use(self, driver: Driver) -> None:
        """Stop, let go of the device, and connect to another one, without any inverse.

        Raises
        ------
        RefusedError
            If the other driver is for another robot.
        """
        super().use(driver)
        self._inverses = MappingProxyType({})

    @property
    def _on_device(self) -> Mapping[str, Exceedance]:
        driver = self.driver
        return driver.compensated if isinstance(driver, Compensator) else {}

    def _change(self, axis: str, model: InverseModel | None, permit: Permit) -> None:
        if self.compensates_all:
            with self._worker.ownership.claimed((axis,), OPERATOR):
                self._mailbox.post(Compensate(axis, model), permit.owned((axis,), OPERATOR))

    def _check_seen(self, targets: Mapping[str, float]) -> None:
        """Refuse targets beyond what the inverse of their axis saw."""
        if not self.compensates_all:
            return
        for axis, inverse in self.compensated.items():
            low, high = inverse.model.desired_range
            slack = 1e-9 * inverse.model.span
            if axis in targets and not low - slack <= targets[axis] <= high + slack:
                unit = inverse.model.unit
                raise OutOfLimitsError(
                    f"axis {axis}: target {readable(targets[axis], unit)} is beyond "
                    f"{readable(low, unit)} to {readable(high, unit)}, which its inverse was "
                    "trained on; stay inside, or switch the compensation off"
                )

    def _sent(
        self, trajectory: CheckedTrajectory
    ) -> tuple[CheckedTrajectory | None, dict[str, str]]:
        """Return what is sent in place of a trajectory, if anything, and what inverses are called.

        What goes through the inverses is held against every limit too, before anything moves.
        """
        commanded = trajectory.commands.axes
        used = {axis: one for axis, one in self.compensated.items() if axis in commanded}
        names = {axis: one.name for axis, one in used.items()}
        if not used:
            return None, names
        commands, live = trajectory.commands, self.compensates_all
        if live:
            commands = on_ticks(commands, self.setpoint_period_s)
        sent = compensated_trajectory(
            self.robot, commands, used, self.setpoint_period_s, preview=not live
        )
        return (None if live else sent), names


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
            f"compensated trajectory: {error}; what brings the wanted path about is beyond a "
            "limit: make it slower, smoother, or smaller"
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
            f"{inverse.name}: it was trained for robot {inverse.robot!r}, not for {robot.name!r}; "
            "train one on this robot"
        )
    described = robot.axes.get(axis)
    if not isinstance(described, PiezoAxis) or described.controller is not None:
        raise CompensationError(
            f"{inverse.name}: axis {axis} is no piezo in open loop of robot {robot.name!r}"
        )
    if not described.range[0] <= inverse.model.command_range[0] < described.range[1]:
        raise CompensationError(f"{inverse.name}: axis {axis} had another range; train it anew")
