"""A trajectory that has been checked against the limits of a robot and cannot change afterwards."""

from dataclasses import dataclass
from hashlib import blake2b

import numpy as np

from rotemina.sim.errors import TrajectoryError
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import Robot
from rotemina.sim.trajectory.trajectory_excesses import check_trajectory, commands_of

# Periods that differ by less than this, relatively, are equal.
_PERIOD_TOLERANCE_RATIO = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class CheckedTrajectory:
    """Commands that a robot may play; made only by :func:`check_and_seal` or a dry run.

    Attributes
    ----------
    robot : Robot
        The robot whose limits were checked.
    commands : Record
        A copy of the ``cmd`` channels, so that the checked commands cannot be changed.
    setpoint_period_s : float
        Set-point period of the device for which the trajectory was checked.
    digest : str
        Hash of the times and commands, which is the same for equal trajectories.
    """

    robot: Robot
    commands: Record
    setpoint_period_s: float
    digest: str

    @classmethod
    def seal(
        cls, robot: Robot, trajectory: Record, setpoint_period_s: float
    ) -> "CheckedTrajectory":
        """Return a checked trajectory; the caller must have checked the commands."""
        commands = Record.from_signals(
            trajectory.time_s.copy(),
            {(name, Tap.CMD): command for name, command in commands_of(robot, trajectory).items()},
            trajectory.units,
            trajectory.metadata,
        )
        return cls(robot, commands, setpoint_period_s, _compute_digest(commands))

    def is_valid_for(self, setpoint_period_s: float) -> bool:
        """Return whether the check is also valid for a device with this set-point period.

        A longer period lowers the speed of jumps, so it is accepted. Controllers run at the
        set-point rate, so with a controller the period must be the same.
        """
        ratio = setpoint_period_s / self.setpoint_period_s
        has_controller = any(self.robot.axes[name].controller for name in self.commands.axes)
        max_ratio = 1.0 + _PERIOD_TOLERANCE_RATIO if has_controller else float("inf")
        return 1.0 - _PERIOD_TOLERANCE_RATIO <= ratio <= max_ratio


def check_and_seal(robot: Robot, trajectory: Record, setpoint_period_s: float) -> CheckedTrajectory:
    """Check a trajectory against the limits and return it as a checked trajectory.

    Raises
    ------
    TrajectoryError, OutOfLimitsError
        As in :func:`rotemina.sim.trajectory.check_trajectory`.
    """
    check_trajectory(robot, trajectory, setpoint_period_s=setpoint_period_s)
    return CheckedTrajectory.seal(robot, trajectory, setpoint_period_s)


def accept_trajectory(
    robot: Robot, trajectory: Record | CheckedTrajectory, setpoint_period_s: float
) -> CheckedTrajectory:
    """Return a trajectory that a device may play, after checking it if necessary.

    Raises
    ------
    TrajectoryError
        If the trajectory was checked for another robot, or as in :func:`check_and_seal`.
    OutOfLimitsError
        As in :func:`check_and_seal`.
    """
    if isinstance(trajectory, Record):
        return check_and_seal(robot, trajectory, setpoint_period_s)
    if trajectory.robot is not robot and trajectory.robot != robot:
        raise TrajectoryError(
            "trajectory: it was checked for robot {name} with other axes or limits than those "
            "of {robot_name}; check it for this one",
            name=repr(trajectory.robot.name),
            robot_name=repr(robot.name),
        )
    if trajectory.is_valid_for(setpoint_period_s):
        return trajectory
    return check_and_seal(robot, trajectory.commands, setpoint_period_s)


def _compute_digest(commands: Record) -> str:
    digest = blake2b(digest_size=8)
    digest.update(commands.time_s.data)
    for channel in commands.columns:
        digest.update(f"{channel} [{commands.units[channel.axis]}]".encode())
        digest.update(np.ascontiguousarray(commands.signal(*channel)).data)
    return digest.hexdigest()
