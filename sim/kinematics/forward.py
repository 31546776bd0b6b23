"""Where the tip is and how it moves: forward kinematics and exact Jacobians.

With the pin's signed length along the tool axis ``L = zn − pin_length`` (negative: the tip hangs
below the pivot)::

    p_tip = [x, y, z] + L a,      a = R_y(thy) R_x(thx) e_z
                                    = [sin thy cos thx, −sin thx, cos thy cos thx]

Source: the serial chain of the robot's nominal description; R_x, R_y are right-handed rotations.
The tool axis ``a`` points from the tip to the pivot, so a growing zn lifts the tip as z does.
The Jacobian is ∂p/∂[x y z] = 1, ∂p/∂zn = a, ∂p/∂thx = L ∂a/∂thx, ∂p/∂thy = L ∂a/∂thy.
"""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.chain import NANO, TABLES, Chain


def tool_axis(joints: FloatArray) -> FloatArray:
    """Return the unit vectors (..., 3) from tip to pivot, for joints (..., 6)."""
    return _axis(joints[..., 3], joints[..., 4])


def tip_position(chain: Chain, joints: FloatArray) -> FloatArray:
    """Return the tip (..., 3), m, of joints (..., 6)."""
    return np.asarray(joints[..., TABLES] + tip_from_pivot(chain, joints[..., NANO]))


def tip_from_pivot(chain: Chain, nano: FloatArray) -> FloatArray:
    """Return the vector (..., 3), m, from pivot to tip for thx, thy, zn in ``nano`` (..., 3)."""
    length = nano[..., 2] - chain.pin_length
    return np.asarray(length[..., None] * _axis(nano[..., 0], nano[..., 1]))


def tip_jacobian(chain: Chain, joints: FloatArray) -> FloatArray:
    """Return ∂p_tip/∂q (..., 3, 6): m/m for lengths, m/rad for tilts."""
    length = (joints[..., 5] - chain.pin_length)[..., None]
    turned = axis_jacobian(joints)
    jacobian = np.zeros((*joints.shape[:-1], 3, 6), dtype=joints.dtype)
    jacobian[..., TABLES] = np.eye(3)
    jacobian[..., 3] = length * turned[..., 3]
    jacobian[..., 4] = length * turned[..., 4]
    jacobian[..., 5] = tool_axis(joints)
    return jacobian


def axis_jacobian(joints: FloatArray) -> FloatArray:
    """Return ∂a/∂q (..., 3, 6), 1/rad; zero but for the columns of thx and thy."""
    sin_x, cos_x = np.sin(joints[..., 3]), np.cos(joints[..., 3])
    sin_y, cos_y = np.sin(joints[..., 4]), np.cos(joints[..., 4])
    jacobian = np.zeros((*joints.shape[:-1], 3, 6), dtype=joints.dtype)
    jacobian[..., 3] = np.stack([-sin_y * sin_x, -cos_x, -cos_y * sin_x], axis=-1)
    jacobian[..., 4] = np.stack([cos_y * cos_x, np.zeros_like(cos_x), -sin_y * cos_x], axis=-1)
    return jacobian


def turned_angle(first: FloatArray, second: FloatArray) -> FloatArray:
    """Return by which angle (...), rad, the tool axis differs between joints (..., 6).

    From sine and cosine together, which keeps small angles exact.
    """
    one, other = tool_axis(first), tool_axis(second)
    sine = np.linalg.norm(np.cross(one, other), axis=-1)
    return np.asarray(np.arctan2(sine, (one * other).sum(axis=-1)))


def _axis(thx: FloatArray, thy: FloatArray) -> FloatArray:
    sin_x, cos_x = np.sin(thx), np.cos(thx)
    parts = np.broadcast_arrays(np.sin(thy) * cos_x, -sin_x, np.cos(thy) * cos_x)
    return np.stack(parts, axis=-1)
