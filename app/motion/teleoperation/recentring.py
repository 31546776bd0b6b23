"""Moving the nano stage, such as to mid-range, while the tip stays in place.

Two even ramps do not hold the tip, they miss by 0.17 µm and more: a table steps by whole
microsteps, overshoots by 62 %, and lags behind. Here the tables step at an even pace and the nano
stage follows not what they are told but where the model expects them: with the tables' motion
``p(t)`` from the plant, the nano joints q that keep the tip come from the exact kinematics, and
their commands u from Eq. (1) of the nano stage::

    C u = M q̈ + D q̇ + C q + M_tables p̈

each taken as its mean over the time for which a device holds it. As the pin's mass then stays
where it is, M drops out of zn's, which so hardly rings. What is left comes from the set-points
being held; it is measured on the plant, for a few paces, and the best pace is taken. With
set-points of 5 ms, a linear program finds a least peak over a microstep of 87 nm, or of 29 nm if
the boards interpolated zn between set-points.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.kinematics.aiming import free_pose
from rotemina.sim.kinematics.chain import JOINTS, NANO, TABLES, Chain
from rotemina.sim.kinematics.forward import tip_position
from rotemina.sim.kinematics.pivoting import recentre
from rotemina.sim.messages import AxisName, joined, marked, message
from rotemina.sim.plant.plant import Plant
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.matrices import inertia_matrices
from rotemina.sim.trajectory.axis_limits import check_target, resolution_of

_PACES = (1, 2, 3, 4)  # set-points a microstep that are tried
_LOOK_S = 1e-4  # between two looks at the motion
_AFTER_S = 0.1  # for which commands go on following the tables' ringing
_PASSES = 3  # how tables and nano stage move each other is settled by then


class RecentringError(InputError):
    """Joints from which the nano stage cannot be brought to mid-range."""


@dataclass(frozen=True, slots=True, eq=False)
class Recentring:
    """A path of the joints that keeps the tip in place.

    ``trajectory`` is what to play, from the present commands on; ``strayed_m`` (3,) is how far the
    tip leaves its place meanwhile, by the model.
    """

    trajectory: Record
    strayed_m: FloatArray


class _Way(NamedTuple):
    """Commands (rows, 6) and the tip's deviation (n, 3), m, between them."""

    commands: FloatArray
    strayed: FloatArray


def plan_recentring(
    chain: Chain,
    commands: Mapping[str, float],
    setpoint_period_s: float,
    joints: tuple[str, ...] = ("zn",),
) -> Recentring:
    """Plan how to bring nano joints to the middle of their ranges while the tip stays.

    Parameters and errors as of :func:`plan_with_tip_held`, to which this gives the targets of the
    ``joints``.
    """
    targets = {joint: float(chain.centre[JOINTS.index(joint)]) for joint in _nano(joints)}
    return plan_with_tip_held(chain, commands, setpoint_period_s, targets)


def plan_with_tip_held(
    chain: Chain,
    commands: Mapping[str, float],
    setpoint_period_s: float,
    targets: Mapping[str, float],
) -> Recentring:
    """Plan how to bring nano joints to targets while the tip stays.

    Parameters
    ----------
    chain : Chain
    commands : mapping of str to float
        Present commands of the joints, m or rad; the machine rests there.
    setpoint_period_s : float
        Of the device that shall play it.
    targets : mapping of str to float
        Where which of thx, thy, zn are to be, m or rad.

    Raises
    ------
    RecentringError
        If a joint is no nano joint, or the place of one is not known.
    OutOfLimitsError
        If a target is out of its range, or a table would leave its own.
    """
    columns = [JOINTS.index(joint) for joint in _nano(tuple(targets))]
    start = _known(commands)
    for joint, target in targets.items():
        check_target(chain.robot, joint, target)
    nano = start.copy()
    nano[columns] = list(targets.values())
    end = recentre(chain, start, nano[NANO])
    ways = [_follow(chain, start, end, setpoint_period_s, pace) for pace in _PACES]
    best = min(ways, key=lambda way: float(np.abs(way.strayed).max()))
    moved = np.flatnonzero(np.ptp(best.commands, axis=0) > 0.0).tolist() or columns
    time_s = np.arange(len(best.commands), dtype=np.float64) * setpoint_period_s
    trajectory = Record.from_signals(
        time_s,
        {(JOINTS[k], Tap.CMD): best.commands[:, k] for k in moved},
        {JOINTS[k]: "rad" if JOINTS[k] in ("thx", "thy") else "m" for k in moved},
        {"mode": "open_loop"},
    )
    return Recentring(trajectory, np.abs(best.strayed).max(axis=0))


def _follow(chain: Chain, start: FloatArray, end: FloatArray, period_s: float, pace: int) -> _Way:
    """Return the way on which the fastest table steps once in ``pace`` set-points."""
    plant = Plant.of(chain.robot)
    tables = _staircases(chain, start, end, pace)
    rows = len(tables) + round(_AFTER_S / period_s)
    commands = np.tile(start, (rows, 1))
    commands[:, TABLES] = np.pad(tables, ((0, rows - len(tables)), (0, 0)), mode="edge")
    tip = tip_position(chain, start)
    looks = max(round(period_s / _LOOK_S), 4)
    for _ in range(_PASSES):
        motion = _respond(plant, chain, commands, period_s, looks)
        pose = free_pose(chain, tip - motion[:, TABLES])
        asked = _asked(chain, motion[:, TABLES], pose, period_s / looks)
        held = asked.reshape(rows, looks, 3).mean(axis=1)
        moving = np.abs(end - start)[NANO] > 0.0
        commands[1:, NANO] = np.where(moving, held[1:], start[NANO])
        commands[-1, NANO] = np.where(moving, pose[-1], start[NANO])
        commands[:, NANO] = np.clip(commands[:, NANO], chain.lower[NANO], chain.upper[NANO])
    strayed = tip_position(chain, _respond(plant, chain, commands, period_s, looks)) - tip
    return _Way(commands, strayed)


def _staircases(chain: Chain, start: FloatArray, end: FloatArray, pace: int) -> FloatArray:
    """Return the tables' commands (rows, 3): whole microsteps, evenly, all to the same end."""
    # A table's microstep, m: its sensor's resolution, to which boards round.
    axes = [chain.robot.axes[name] for name in JOINTS[TABLES]]
    steps = np.array([resolution_of(axis) or 1e-7 for axis in axes])
    whole = np.rint((end - start)[TABLES] / steps)
    count = int(np.abs(whole).max())
    share = np.arange(count * pace + 1) // pace / max(count, 1)
    return np.asarray(start[TABLES] + np.rint(share[:, None] * whole) * steps)


def _respond(
    plant: Plant, chain: Chain, commands: FloatArray, period_s: float, looks: int
) -> FloatArray:
    """Return the joints (rows * looks, 6) from rest, before each look, under held commands."""
    others = np.array([axis.range[0] for axis in plant.robot.axes.values()], dtype=np.float64)
    inputs = np.repeat(chain.positions_of(commands, others), looks, axis=0)
    time_s = np.arange(len(inputs), dtype=np.float64) * (period_s / looks)
    motion, _ = plant.advance(plant.at_rest(0.0, inputs[0]), time_s, inputs)
    return chain.joints_of(motion.position)


def _asked(chain: Chain, tables: FloatArray, pose: FloatArray, dt: float) -> FloatArray:
    """Return the commands (n, 3) under which the nano joints move as ``pose`` (n, 3)."""
    axes, mass, damping, stiffness = inertia_matrices(chain.robot)
    order = [axes.index(name) for name in JOINTS]
    m, d, c = (matrix[np.ix_(order, order)] for matrix in (mass, damping, stiffness))
    joints = np.concatenate([tables, pose], axis=1)
    speed = np.gradient(joints, dt, axis=0)
    force = np.gradient(speed, dt, axis=0) @ m.T + speed @ d.T + joints @ c.T
    return np.asarray(force[:, NANO] / np.diagonal(c)[NANO])


def _nano(joints: tuple[str, ...]) -> tuple[str, ...]:
    """Return the joints; refuse those that are none of the nano stage."""
    wrong = [joint for joint in joints if joint not in JOINTS[NANO]]
    if wrong or not joints:
        raise RecentringError(
            message(
                "engine",
                "re-centring: {value}: must be one of thx, thy, zn; only these have a middle "
                "to return to",
            ).fill(value=", ".join(wrong) or marked("engine", "no joint"))
        )
    return joints


def _known(commands: Mapping[str, float]) -> FloatArray:
    missing = [joint for joint in JOINTS if joint not in commands]
    if missing:
        raise RecentringError(
            message(
                "engine",
                "re-centring: the position of axis {names} is not known; connect and home first",
            ).fill(names=joined(map(AxisName, missing), ", "))
        )
    return np.array([commands[joint] for joint in JOINTS], dtype=np.float64)
