"""Inverse kinematics: joints for a tip position, shared between the micro and the nano stage."""

from enum import StrEnum

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import OutOfLimitsError
from rotemina.sim.kinematics.aiming import aim_pin, solve_free_pose
from rotemina.sim.kinematics.chain import NANO, TABLES, KinematicChain
from rotemina.sim.kinematics.forward import compute_tip_from_pivot

_ROUNDING_RATIO = 8.0 * float(np.finfo(np.float64).eps)


class StageSplit(StrEnum):
    """Choice of the stage that brings the tip to its target.

    ``MICRO_ONLY``: the tables move. The nano joints stay, or take the requested tilt.

    ``NANO_FIRST``: the nano stage moves within its limits, and the tables do the rest. Sideways
    motion by tilting changes the orientation of the pin.

    ``HYBRID``: as ``NANO_FIRST`` while the target is within reach of the nano stage. A nano joint
    that would leave its range goes to the middle of its range instead, and the tables make up for
    it. Fine motion then has room in both directions again.
    """

    MICRO_ONLY = "micro_only"
    NANO_FIRST = "nano_first"
    HYBRID = "hybrid"


def solve_tip(
    chain: KinematicChain,
    target: FloatArray,
    start: FloatArray,
    split: StageSplit = StageSplit.HYBRID,
    tilt: FloatArray | None = None,
) -> FloatArray:
    """Return joints (..., 6) that put the tip exactly on ``target``.

    Parameters
    ----------
    chain : KinematicChain
    target : (..., 3)
        Target position of the tip, m.
    start : (..., 6)
        Joints before the move. Joints that need not move keep these positions.
    split : StageSplit
        Which stage moves. If re-centring would push a table beyond its end, ``HYBRID`` falls back
        to ``NANO_FIRST``.
    tilt : (..., 2), optional
        Final thx, thy, rad. The tables alone then move the tip sideways.

    Raises
    ------
    OutOfLimitsError
        If the target is not finite, or a joint would leave its range: the message names axis,
        value and bounds. Targets are never clipped silently.
    """
    target, start = _broadcast_pair(target, start)
    lower, upper = _make_nano_bounds(chain, target, tilt)
    if split is StageSplit.MICRO_ONLY:
        nano = start[..., NANO]
        if tilt is not None:
            nano = np.concatenate([lower[..., :2], nano[..., 2:]], axis=-1)
        return chain.check(_add_tables(chain, target, start, nano))
    pivot_to_target = target - start[..., TABLES]
    pose, unclipped = aim_pin(chain, pivot_to_target, lower, upper)
    joints = _add_tables(chain, target, start, pose)
    if split is StageSplit.HYBRID:
        slack = chain.slack[NANO]
        exceeds = (unclipped < lower - slack) | (unclipped > upper + slack)
        middle = 0.5 * (lower + upper)
        bounds = np.where(exceeds, middle, lower), np.where(exceeds, middle, upper)
        recentred = _add_tables(chain, target, start, aim_pin(chain, pivot_to_target, *bounds).pose)
        joints = np.where(chain.is_inside(recentred)[..., None], recentred, joints)
    return chain.check(joints)


def solve_nano(chain: KinematicChain, target: FloatArray, start: FloatArray) -> FloatArray:
    """Return joints (..., 6) that put the tip on ``target`` (..., 3), m, while the tables stay.

    Raises
    ------
    OutOfLimitsError
        If a nano axis does not reach. The message names the axis, its value and its bounds.
    """
    target, start = _broadcast_pair(target, start)
    nano = solve_free_pose(chain, target - start[..., TABLES])
    return chain.check(np.concatenate([start[..., TABLES], nano], axis=-1))


def _broadcast_pair(target: FloatArray, start: FloatArray) -> tuple[FloatArray, FloatArray]:
    target, start = np.asarray(target, dtype=np.float64), np.asarray(start, dtype=np.float64)
    if not np.isfinite(target).all():
        raise OutOfLimitsError("tip: the target is not a finite position; give x, y and z in m")
    shape = np.broadcast_shapes(target.shape[:-1], start.shape[:-1])
    return np.broadcast_to(target, (*shape, 3)), np.broadcast_to(start, (*shape, 6))


def _make_nano_bounds(
    chain: KinematicChain, target: FloatArray, tilt: FloatArray | None
) -> tuple[FloatArray, FloatArray]:
    """Return the bounds (..., 3) of thx, thy, zn; both equal the tilt if one is requested."""
    lower = np.array(np.broadcast_to(chain.lower[NANO], target.shape))
    upper = np.array(np.broadcast_to(chain.upper[NANO], target.shape))
    if tilt is not None:
        lower[..., :2] = upper[..., :2] = tilt
    return lower, upper


def _add_tables(
    chain: KinematicChain, target: FloatArray, start: FloatArray, nano: FloatArray
) -> FloatArray:
    """Return joints (..., 6) with the nano pose and the tables that put the tip on the target."""
    tables = target - compute_tip_from_pivot(chain, nano)
    table_move = tables - start[..., TABLES]
    rounding = _ROUNDING_RATIO * (np.abs(target) + chain.pin_length)
    # If the nano stage alone reaches the target, a rounding error must not move a table.
    tables = np.where(np.abs(table_move) <= rounding, start[..., TABLES], tables)
    return np.concatenate([tables, nano], axis=-1)
