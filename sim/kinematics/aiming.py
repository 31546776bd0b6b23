"""The nano pose that brings the tip nearest to a point, from a pivot that stays.

Given the vector v from pivot to target, the free solution is exact::

    L = −|v|,   sin thx = −v_y / L,   sin thy = v_x / (L cos thx),   zn = pin_length + L

Where it leaves the bounds, the joints are found by turns, each with the others given and cut to
its bounds: thx serves y, thy serves x, zn serves z. They depend on one another only through
cosines of the tilts, so a few turns reach rounding.
"""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.chain import Chain

_TURNS = 60
_ROUNDING = 4.0 * float(np.finfo(np.float64).eps)


class Aim(NamedTuple):
    """``pose`` (..., 3) within the bounds, and ``free``, each joint as it would be without its own.

    Both thx, thy (rad), zn (m).
    """

    pose: FloatArray
    free: FloatArray


def aim(chain: Chain, reach: FloatArray, lower: FloatArray, upper: FloatArray) -> Aim:
    """Aim the pin along ``reach`` (..., 3), m, from pivot to target.

    ``lower`` and ``upper`` (..., 3) bound thx, thy, zn; a joint that must stay has both equal.
    The tip misses the target by what the bounds forbid, each coordinate by the least possible
    to second order in the tilts (see :attr:`rotemina.sim.kinematics.workspace.Workspace.blur`).
    """
    length = np.clip(_free_length(chain, reach), lower[..., 2], upper[..., 2]) - chain.pin_length
    for _ in range(_TURNS):
        free = _free_joints(chain, reach, length, lower, upper)
        pose = np.clip(free, lower, upper)
        before, length = length, pose[..., 2] - chain.pin_length
        if np.abs(length - before).max(initial=0.0) <= _ROUNDING * chain.pin_length:
            break
    return Aim(pose, free)


def free_pose(chain: Chain, reach: FloatArray) -> FloatArray:
    """Return thx, thy, zn (..., 3) that reach exactly, whatever the bounds.

    A target above the pivot has no such pose; what is returned then lies outside every range.
    """
    zn = _free_length(chain, reach)
    length = zn - chain.pin_length
    end = np.full(3, np.pi / 2)
    pose = _free_joints(chain, reach, np.where(length == 0.0, -chain.pin_length, length), -end, end)
    pose[..., 2] = zn
    return pose


def _free_length(chain: Chain, reach: FloatArray) -> FloatArray:
    """Return zn (...) at which the pin is as long as ``reach``; pin_length and more above it."""
    below = reach[..., 2] < 0.0
    distance = np.linalg.norm(reach, axis=-1)
    return np.asarray(chain.pin_length + np.where(below, -distance, distance))


def _free_joints(
    chain: Chain, reach: FloatArray, length: FloatArray, lower: FloatArray, upper: FloatArray
) -> FloatArray:
    thx = _arcsine(-reach[..., 1] / length)
    cos_x = np.cos(np.clip(thx, lower[..., 0], upper[..., 0]))
    thy = _arcsine(reach[..., 0] / (length * cos_x))
    cos_y = np.cos(np.clip(thy, lower[..., 1], upper[..., 1]))
    zn = chain.pin_length + reach[..., 2] / (cos_x * cos_y)
    return np.stack([thx, thy, zn], axis=-1)


def _arcsine(sine: FloatArray) -> FloatArray:
    return np.asarray(np.arcsin(np.clip(sine, -1.0, 1.0)))
