"""Joint positions for a wanted tip, shared between the micro and the nano stage."""

from enum import StrEnum

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.aiming import aim, free_pose
from rotemina.sim.kinematics.chain import NANO, TABLES, Chain
from rotemina.sim.kinematics.forward import tip_from_pivot
from rotemina.sim.messages import message
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError

_ROUNDING = 8.0 * float(np.finfo(np.float64).eps)


class Split(StrEnum):
    """Which stage brings the tip to its target.

    ``MICRO_ONLY``: the tables; the nano joints stay, or take the tilt that is requested.
    ``NANO_FIRST``: the nano stage as far as its joints go (tilt costs orientation), tables the
    rest. ``HYBRID``: as nano first while the nano stage reaches; a nano joint whose part does not
    fit goes to the middle of its range instead, so that fine motion has room both ways again.
    """

    MICRO_ONLY = "micro_only"
    NANO_FIRST = "nano_first"
    HYBRID = "hybrid"


def solve_tip(
    chain: Chain,
    target: FloatArray,
    start: FloatArray,
    split: Split = Split.HYBRID,
    tilt: FloatArray | None = None,
) -> FloatArray:
    """Return joints (..., 6) that put the tip on ``target``, exactly.

    Parameters
    ----------
    chain : Chain
    target : (..., 3)
        Of the tip, m.
    start : (..., 6)
        Joints before the move: what stays if it can.
    split : Split
        Which stage moves. Where re-centring would push a table beyond its end, ``HYBRID``
        falls back to ``NANO_FIRST``.
    tilt : (..., 2), optional
        thx, thy to end with, rad. Sideways motion is then the tables' alone.

    Raises
    ------
    OutOfLimitsError
        If the target is not finite, or with axis, value and bounds: nothing is ever cut silently.
    """
    target, start = _paired(target, start)
    lower, upper = _nano_bounds(chain, target, tilt)
    if split is Split.MICRO_ONLY:
        nano = start[..., NANO]
        if tilt is not None:
            nano = np.concatenate([lower[..., :2], nano[..., 2:]], axis=-1)
        return chain.check(_complete(chain, target, start, nano))
    reach = target - start[..., TABLES]
    pose, wish = aim(chain, reach, lower, upper)
    joints = _complete(chain, target, start, pose)
    if split is Split.HYBRID:
        slack = chain.slack[NANO]
        over = (wish < lower - slack) | (wish > upper + slack)
        middle = 0.5 * (lower + upper)
        held = np.where(over, middle, lower), np.where(over, middle, upper)
        centred = _complete(chain, target, start, aim(chain, reach, *held).pose)
        joints = np.where(chain.inside(centred)[..., None], centred, joints)
    return chain.check(joints)


def solve_nano(chain: Chain, target: FloatArray, start: FloatArray) -> FloatArray:
    """Return joints (..., 6) that put the tip on ``target`` (..., 3), m, while the tables stay.

    Raises
    ------
    OutOfLimitsError
        With the nano axis that does not reach, its value and bounds.
    """
    target, start = _paired(target, start)
    nano = free_pose(chain, target - start[..., TABLES])
    return chain.check(np.concatenate([start[..., TABLES], nano], axis=-1))


def _paired(target: FloatArray, start: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return both as float64 of the same leading shape."""
    target, start = np.asarray(target, dtype=np.float64), np.asarray(start, dtype=np.float64)
    if not np.isfinite(target).all():
        raise OutOfLimitsError(
            message("engine", "tip: the target is not a finite position; give x, y and z in m")
        )
    shape = np.broadcast_shapes(target.shape[:-1], start.shape[:-1])
    return np.broadcast_to(target, (*shape, 3)), np.broadcast_to(start, (*shape, 6))


def _nano_bounds(
    chain: Chain, target: FloatArray, tilt: FloatArray | None
) -> tuple[FloatArray, FloatArray]:
    """Return the bounds (..., 3) of thx, thy, zn; a tilt that is requested bounds itself."""
    lower = np.array(np.broadcast_to(chain.lower[NANO], target.shape))
    upper = np.array(np.broadcast_to(chain.upper[NANO], target.shape))
    if tilt is not None:
        lower[..., :2] = upper[..., :2] = tilt
    return lower, upper


def _complete(chain: Chain, target: FloatArray, start: FloatArray, nano: FloatArray) -> FloatArray:
    """Add the tables (..., 3) that bring the tip of a nano pose (..., 3) to the target."""
    tables = target - tip_from_pivot(chain, nano)
    move = tables - start[..., TABLES]
    rounding = _ROUNDING * (np.abs(target) + chain.pin_length)
    # A table is not asked to move by a rounding error: it stays where the nano stage reaches.
    tables = np.where(np.abs(move) <= rounding, start[..., TABLES], tables)
    return np.concatenate([tables, nano], axis=-1)
