"""Forward kinematics of the tip and its exact Jacobians.

The signed length of the pin along the tool axis is ``L = zn − pin_length``. It is negative because
the tip hangs below the pivot::

    p_tip = [x, y, z] + L a,      a = R_y(thy) R_x(thx) e_z
                                    = [sin thy cos thx, −sin thx, cos thy cos thx]

Source: the serial chain of the robot's nominal description; R_x, R_y are right-handed rotations.
The tool axis ``a`` points from the tip to the pivot, so a larger zn raises the tip, as a larger z
does.
The Jacobian is ∂p/∂[x y z] = 1, ∂p/∂zn = a, ∂p/∂thx = L ∂a/∂thx, ∂p/∂thy = L ∂a/∂thy.
"""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.chain import NANO, TABLES, KinematicChain


def compute_tool_axis(joints: FloatArray) -> FloatArray:
    """Return the unit vectors (..., 3) from tip to pivot for joints (..., 6)."""
    return _compute_axis(joints[..., 3], joints[..., 4])


def compute_tip_position(chain: KinematicChain, joints: FloatArray) -> FloatArray:
    """Return the positions (..., 3), m, of the tip for joints (..., 6)."""
    return np.asarray(joints[..., TABLES] + compute_tip_from_pivot(chain, joints[..., NANO]))


def compute_tip_from_pivot(chain: KinematicChain, nano: FloatArray) -> FloatArray:
    """Return the vector (..., 3), m, from pivot to tip for thx, thy, zn in ``nano`` (..., 3)."""
    length = nano[..., 2] - chain.pin_length
    return np.asarray(length[..., None] * _compute_axis(nano[..., 0], nano[..., 1]))


def compute_tip_jacobian(chain: KinematicChain, joints: FloatArray) -> FloatArray:
    """Return ∂p_tip/∂q (..., 3, 6): m/m for lengths, m/rad for tilts."""
    length = (joints[..., 5] - chain.pin_length)[..., None]
    axis_derivative = axis_jacobian(joints)
    jacobian = np.zeros((*joints.shape[:-1], 3, 6), dtype=joints.dtype)
    jacobian[..., TABLES] = np.eye(3)
    jacobian[..., 3] = length * axis_derivative[..., 3]
    jacobian[..., 4] = length * axis_derivative[..., 4]
    jacobian[..., 5] = compute_tool_axis(joints)
    return jacobian


def axis_jacobian(joints: FloatArray) -> FloatArray:
    """Return ∂a/∂q (..., 3, 6), 1/rad; all columns but those of thx and thy are zero."""
    sin_x, cos_x = np.sin(joints[..., 3]), np.cos(joints[..., 3])
    sin_y, cos_y = np.sin(joints[..., 4]), np.cos(joints[..., 4])
    jacobian = np.zeros((*joints.shape[:-1], 3, 6), dtype=joints.dtype)
    jacobian[..., 3] = np.stack([-sin_y * sin_x, -cos_x, -cos_y * sin_x], axis=-1)
    jacobian[..., 4] = np.stack([cos_y * cos_x, np.zeros_like(cos_x), -sin_y * cos_x], axis=-1)
    return jacobian


def angle_between_tool_axes(first: FloatArray, second: FloatArray) -> FloatArray:
    """Return the angles (...), rad, between the tool axes of two sets of joints (..., 6).

    Sine and cosine are used together, which keeps small angles accurate.
    """
    first_axis, second_axis = compute_tool_axis(first), compute_tool_axis(second)
    sine = np.linalg.norm(np.cross(first_axis, second_axis), axis=-1)
    return np.asarray(np.arctan2(sine, (first_axis * second_axis).sum(axis=-1)))


def _compute_axis(thx: FloatArray, thy: FloatArray) -> FloatArray:
    sin_x, cos_x = np.sin(thx), np.cos(thx)
    components = np.broadcast_arrays(np.sin(thy) * cos_x, -sin_x, np.cos(thy) * cos_x)
    return np.stack(components, axis=-1)
