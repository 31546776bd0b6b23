"""A trajectory that was found within the limits of one robot, sealed so that it stays so."""

from dataclasses import dataclass
from hashlib import blake2b

import numpy as np

from rotemina.sim.messages import message
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.trajectory_excesses import (
    TrajectoryError,
    check_trajectory,
    commands_of,
)

_SAME_PERIOD = 1e-6  # relative


@dataclass(frozen=True, slots=True, eq=False)
class CheckedTrajectory:
    """Commands that a robot may play; made by :func:`check` or a dry run, not by hand.

    Attributes
    ----------
    robot : Robot
        Whose limits were asked.
    commands : Record
        A copy of the ``cmd`` channels, so that nobody changes what was checked.
    setpoint_period_s : float
        Of the device for which it was checked.
    digest : str
        Of times and commands, the same for equal trajectories.
    """

    robot: Robot
    commands: Record
    setpoint_period_s: float
    digest: str

    @classmethod
    def sealed(
        cls, robot: Robot, trajectory: Record, setpoint_period_s: float
    ) -> "CheckedTrajectory":
        """Return a trajectory that the caller has just checked."""
        commands = Record.from_signals(
            trajectory.time_s.copy(),
            {(name, Tap.CMD): each for name, each in commands_of(robot, trajectory).items()},
            trajectory.units,
            trajectory.metadata,
        )
        return cls(robot, commands, setpoint_period_s, _digest(commands))

    def holds_for(self, setpoint_period_s: float) -> bool:
        """Whether a device with this period is no stricter, and closes loops at the same rate."""
        shorter = setpoint_period_s / self.setpoint_period_s
        controlled = any(self.robot.axes[name].controller for name in self.commands.axes)
        most = 1.0 + _SAME_PERIOD if controlled else float("inf")
        return 1.0 - _SAME_PERIOD <= shorter <= most


def check(robot: Robot, trajectory: Record, setpoint_period_s: float) -> CheckedTrajectory:
    """Check a trajectory against the limits.

    Raises
    ------
    TrajectoryError, OutOfLimitsError
        As :func:`rotemina.sim.trajectory.trajectory_excesses.check_trajectory`.
    """
    check_trajectory(robot, trajectory, setpoint_period_s=setpoint_period_s)
    return CheckedTrajectory.sealed(robot, trajectory, setpoint_period_s)


def accepted(
    robot: Robot, trajectory: Record | CheckedTrajectory, setpoint_period_s: float
) -> CheckedTrajectory:
    """Return a trajectory that a device may play; one that was checked for it is not checked again.

    Raises
    ------
    TrajectoryError
        If it was checked for another robot, or as :func:`check`.
    OutOfLimitsError
        As :func:`check`.
    """
    if isinstance(trajectory, Record):
        return check(robot, trajectory, setpoint_period_s)
    if trajectory.robot is not robot and trajectory.robot != robot:
        raise TrajectoryError(
            message(
                "engine",
                "trajectory: it was checked for robot {name} with other axes or limits than those "
                "of {robot_name}; check it for this one",
            ).fill(name=repr(trajectory.robot.name), robot_name=repr(robot.name))
        )
    if trajectory.holds_for(setpoint_period_s):
        return trajectory
    return check(robot, trajectory.commands, setpoint_period_s)


def _digest(commands: Record) -> str:
    digest = blake2b(digest_size=8)
    digest.update(commands.time_s.data)
    for channel in commands.columns:
        digest.update(f"{channel} [{commands.units[channel.axis]}]".encode())
        digest.update(np.ascontiguousarray(commands.signal(*channel)).data)
    return digest.hexdigest()
