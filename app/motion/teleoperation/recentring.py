"""Motions of the nano stage, for example to mid-range, while the tip stays in place.

Two uniform ramps do not hold the tip. They move it by 0.17 µm and more, because a table moves in
whole microsteps, overshoots by 62 %, and lags behind. Here the tables step at a constant rate. The
nano stage does not follow the commands of the tables, but the motion ``p(t)`` that the plant model
predicts for them. The exact kinematics give the nano joints q that hold the tip, and Eq. (1) of the
nano stage gives their commands u::

    C u = M q̈ + D q̇ + C q + M_tables p̈

Each command is the mean of u over the time for which a device holds the command. The mass of the
pin then stays in place, so M drops out of the equation for zn, and zn hardly rings. The remaining
error comes from holding the set-points. It is simulated for several step rates, and the best rate
is chosen. For comparison: with set-points every 5 ms, a linear program finds that the peak error
over a microstep cannot be smaller than 87 nm, or 29 nm if the boards interpolated zn between
set-points.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rotemina.app.errors import RecentringError
from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics import (
    JOINTS,
    NANO,
    TABLES,
    KinematicChain,
    compute_tip_position,
    recentre,
    solve_free_pose,
)
from rotemina.sim.messages import (
    AxisName,
    join_messages,
    marked,
)
from rotemina.sim.plant import Plant
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import assemble_inertia_matrices
from rotemina.sim.trajectory import check_target, get_command_resolution

# Step rates of the tables that are tried, in set-points per microstep.
_SETPOINTS_PER_MICROSTEP = (1, 2, 3, 4)
# Step of the simulation.
_PLANT_STEP_S = 1e-4
# The nano stage follows the ringing of the tables for this long after their last step.
_RINGING_S = 0.1
# Tables and nano stage move each other. The iteration converges in this many passes.
_PASS_COUNT = 3


@dataclass(frozen=True, slots=True, eq=False)
class RecentringPlan:
    """Plan of a joint motion that keeps the tip in place.

    Attributes
    ----------
    trajectory : Record
        Trajectory to be played, which begins at the current commands.
    max_deviation_m : (3,)
        Largest deviation of the tip from its position during the motion, as the model predicts.
    """

    trajectory: Record
    max_deviation_m: FloatArray


class _CandidatePath(NamedTuple):
    """Commands (rows, 6) and the resulting deviation of the tip (n, 3), m."""

    commands: FloatArray
    deviation: FloatArray


def plan_recentring(
    chain: KinematicChain,
    commands: Mapping[str, float],
    setpoint_period_s: float,
    joints: tuple[str, ...] = ("zn",),
) -> RecentringPlan:
    """Plan a motion of nano ``joints`` to the middle of their ranges while the tip stays.

    See :func:`plan_with_tip_held` for the other parameters and the errors.
    """
    targets = {
        joint: float(chain.centre[JOINTS.index(joint)]) for joint in _check_nano_joints(joints)
    }
    return plan_with_tip_held(chain, commands, setpoint_period_s, targets)


def plan_with_tip_held(
    chain: KinematicChain,
    commands: Mapping[str, float],
    setpoint_period_s: float,
    targets: Mapping[str, float],
) -> RecentringPlan:
    """Plan a motion of nano joints to targets while the tip stays.

    Parameters
    ----------
    chain : KinematicChain
    commands : mapping of str to float
        Current commands of the joints, m or rad, at which the machine must be at rest.
    setpoint_period_s : float
        Set-point period of the device that will play the trajectory.
    targets : mapping of str to float
        Targets of some of the joints thx, thy and zn, m or rad.

    Raises
    ------
    RecentringError
        If a joint is not a nano joint, or the position of a joint is not known.
    OutOfLimitsError
        If a target is out of its range, or a table would leave its range.
    """
    columns = [JOINTS.index(joint) for joint in _check_nano_joints(tuple(targets))]
    start = _to_joint_positions(commands)
    for joint, target in targets.items():
        check_target(chain.robot, joint, target)
    end_joints = start.copy()
    end_joints[columns] = list(targets.values())
    end = recentre(chain, start, end_joints[NANO])
    paths = [
        _plan_path(chain, start, end, setpoint_period_s, setpoints_per_step)
        for setpoints_per_step in _SETPOINTS_PER_MICROSTEP
    ]
    best_path = min(paths, key=lambda path: float(np.abs(path.deviation).max()))
    moved_columns = np.flatnonzero(np.ptp(best_path.commands, axis=0) > 0.0).tolist() or columns
    time_s = np.arange(len(best_path.commands), dtype=np.float64) * setpoint_period_s
    trajectory = Record.from_signals(
        time_s,
        {(JOINTS[column], Tap.CMD): best_path.commands[:, column] for column in moved_columns},
        {
            JOINTS[column]: "rad" if JOINTS[column] in ("thx", "thy") else "m"
            for column in moved_columns
        },
        {"mode": "open_loop"},
    )
    return RecentringPlan(trajectory, np.abs(best_path.deviation).max(axis=0))


def _plan_path(
    chain: KinematicChain,
    start: FloatArray,
    end: FloatArray,
    period_s: float,
    setpoints_per_step: int,
) -> _CandidatePath:
    """Return the path on which the fastest table steps every ``setpoints_per_step`` set-points."""
    plant = Plant.of(chain.robot)
    table_commands = _make_staircases(chain, start, end, setpoints_per_step)
    row_count = len(table_commands) + round(_RINGING_S / period_s)
    commands = np.tile(start, (row_count, 1))
    commands[:, TABLES] = np.pad(
        table_commands, ((0, row_count - len(table_commands)), (0, 0)), mode="edge"
    )
    tip = compute_tip_position(chain, start)
    substeps = max(round(period_s / _PLANT_STEP_S), 4)
    for _ in range(_PASS_COUNT):
        motion = _simulate_response(plant, chain, commands, period_s, substeps)
        pose = solve_free_pose(chain, tip - motion[:, TABLES])
        nano_commands = _compute_nano_commands(chain, motion[:, TABLES], pose, period_s / substeps)
        held_commands = nano_commands.reshape(row_count, substeps, 3).mean(axis=1)
        is_moving = np.abs(end - start)[NANO] > 0.0
        commands[1:, NANO] = np.where(is_moving, held_commands[1:], start[NANO])
        commands[-1, NANO] = np.where(is_moving, pose[-1], start[NANO])
        commands[:, NANO] = np.clip(commands[:, NANO], chain.lower[NANO], chain.upper[NANO])
    deviation = (
        compute_tip_position(chain, _simulate_response(plant, chain, commands, period_s, substeps))
        - tip
    )
    return _CandidatePath(commands, deviation)


def _make_staircases(
    chain: KinematicChain, start: FloatArray, end: FloatArray, setpoints_per_step: int
) -> FloatArray:
    """Return commands (rows, 3) of the tables: whole microsteps at uniform rates.

    All tables finish at the same time.
    """
    # The microstep of a table equals the resolution of its sensor, to which boards round.
    axes = [chain.robot.axes[name] for name in JOINTS[TABLES]]
    microstep_m = np.array([get_command_resolution(axis) or 1e-7 for axis in axes])
    microstep_counts = np.rint((end - start)[TABLES] / microstep_m)
    max_count = int(np.abs(microstep_counts).max())
    fractions = (
        np.arange(max_count * setpoints_per_step + 1) // setpoints_per_step / max(max_count, 1)
    )
    return np.asarray(start[TABLES] + np.rint(fractions[:, None] * microstep_counts) * microstep_m)


def _simulate_response(
    plant: Plant, chain: KinematicChain, commands: FloatArray, period_s: float, substeps: int
) -> FloatArray:
    """Return the joints (rows * substeps, 6) for held commands, starting from rest."""
    # Axes that are not joints of the chain stay at the low end of their range.
    other_positions = np.array(
        [axis.range[0] for axis in plant.robot.axes.values()], dtype=np.float64
    )
    inputs = np.repeat(chain.select_positions(commands, other_positions), substeps, axis=0)
    time_s = np.arange(len(inputs), dtype=np.float64) * (period_s / substeps)
    motion, _ = plant.advance(plant.find_rest_state(0.0, inputs[0]), time_s, inputs)
    return chain.select_joints(motion.position)


def _compute_nano_commands(
    chain: KinematicChain, tables: FloatArray, pose: FloatArray, dt: float
) -> FloatArray:
    """Return the commands (n, 3) that move the nano joints along ``pose`` (n, 3)."""
    axes, mass, damping, stiffness = assemble_inertia_matrices(chain.robot)
    joint_columns = [axes.index(name) for name in JOINTS]
    m, d, c = (
        matrix[np.ix_(joint_columns, joint_columns)] for matrix in (mass, damping, stiffness)
    )
    joints = np.concatenate([tables, pose], axis=1)
    speed = np.gradient(joints, dt, axis=0)
    force = np.gradient(speed, dt, axis=0) @ m.T + speed @ d.T + joints @ c.T
    return np.asarray(force[:, NANO] / np.diagonal(c)[NANO])


def _check_nano_joints(joints: tuple[str, ...]) -> tuple[str, ...]:
    other_joints = [joint for joint in joints if joint not in JOINTS[NANO]]
    if other_joints or not joints:
        raise RecentringError(
            "re-centring: {value}: must be one of thx, thy, zn; only these have a middle "
            "to return to",
            value=", ".join(other_joints) or marked("engine", "no joint"),
        )
    return joints


def _to_joint_positions(commands: Mapping[str, float]) -> FloatArray:
    missing = [joint for joint in JOINTS if joint not in commands]
    if missing:
        raise RecentringError(
            "re-centring: the position of axis {names} is not known; connect and home first",
            names=join_messages(map(AxisName, missing), ", "),
        )
    return np.array([commands[joint] for joint in JOINTS], dtype=np.float64)
