"""The nano pose that brings the tip nearest to a target while the pivot stays.

Given the vector v from pivot to target, the solution without bounds is exact::

    L = −|v|,   sin thx = −v_y / L,   sin thy = v_x / (L cos thx),   zn = pin_length + L

If it leaves the bounds, the joints are solved one after the other, each clipped to its bounds
while the others are held: thx for y, thy for x, zn for z. They depend on one another only through
the cosines of the tilts, so a few iterations converge to rounding error.
"""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.chain import KinematicChain

_MAX_ITERATIONS = 60
_ROUNDING_RATIO = 4.0 * float(np.finfo(np.float64).eps)


class AimSolution(NamedTuple):
    """Solution of aiming the pin: thx, thy (rad) and zn (m).

    Attributes
    ----------
    pose : (..., 3)
        Joints within the bounds.
    free : (..., 3)
        Each joint before it was clipped to its own bounds.
    """

    pose: FloatArray
    unclipped: FloatArray


def aim_pin(
    chain: KinematicChain, pivot_to_target: FloatArray, lower: FloatArray, upper: FloatArray
) -> AimSolution:
    """Aim the pin along the vector ``pivot_to_target`` (..., 3), m.

    ``lower`` and ``upper`` (..., 3) bound thx, thy, zn. For a joint that must not move, both are
    equal. If the bounds keep the tip from its target, the error of each coordinate is minimal to
    second order in the tilts, see
    :attr:`rotemina.sim.kinematics.TipWorkspace.max_margin_error`.
    """
    length = (
        np.clip(_solve_free_zn(chain, pivot_to_target), lower[..., 2], upper[..., 2])
        - chain.pin_length
    )
    for _ in range(_MAX_ITERATIONS):
        free = _solve_free_joints(chain, pivot_to_target, length, lower, upper)
        pose = np.clip(free, lower, upper)
        previous_length, length = length, pose[..., 2] - chain.pin_length
        if np.abs(length - previous_length).max(initial=0.0) <= _ROUNDING_RATIO * chain.pin_length:
            break
    return AimSolution(pose, free)


def solve_free_pose(chain: KinematicChain, pivot_to_target: FloatArray) -> FloatArray:
    """Return the thx, thy, zn (..., 3) that reach the target exactly, ignoring the bounds.

    A target above the pivot has no such pose; the returned pose then lies outside every range.
    """
    zn = _solve_free_zn(chain, pivot_to_target)
    length = zn - chain.pin_length
    right_angle = np.full(3, np.pi / 2)
    pose = _solve_free_joints(
        chain,
        pivot_to_target,
        np.where(length == 0.0, -chain.pin_length, length),
        -right_angle,
        right_angle,
    )
    pose[..., 2] = zn
    return pose


def _solve_free_zn(chain: KinematicChain, pivot_to_target: FloatArray) -> FloatArray:
    """Return zn (...) at which the pin is as long as ``pivot_to_target``.

    For a target above the pivot, it is at least ``pin_length``, which is outside every range.
    """
    is_below = pivot_to_target[..., 2] < 0.0
    distance = np.linalg.norm(pivot_to_target, axis=-1)
    return np.asarray(chain.pin_length + np.where(is_below, -distance, distance))


def _solve_free_joints(
    chain: KinematicChain,
    pivot_to_target: FloatArray,
    length: FloatArray,
    lower: FloatArray,
    upper: FloatArray,
) -> FloatArray:
    thx = _arcsine(-pivot_to_target[..., 1] / length)
    cos_x = np.cos(np.clip(thx, lower[..., 0], upper[..., 0]))
    thy = _arcsine(pivot_to_target[..., 0] / (length * cos_x))
    cos_y = np.cos(np.clip(thy, lower[..., 1], upper[..., 1]))
    zn = chain.pin_length + pivot_to_target[..., 2] / (cos_x * cos_y)
    return np.stack([thx, thy, zn], axis=-1)


def _arcsine(sine: FloatArray) -> FloatArray:
    return np.asarray(np.arcsin(np.clip(sine, -1.0, 1.0)))
