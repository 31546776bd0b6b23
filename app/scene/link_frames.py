"""Frames of the kinematic chain: the pose of each link in the frame of the link that carries it.

x carries y, y carries z, z carries the tilting plate (thx, thy), and the plate carries the pin
(zn)::

    base → x: along x → y: along y → z: along z → tilt: R_y(thy) R_x(thx) → pin: zn along its z

The pivot is the origin of ``z`` and ``tilt``, and at zn = 0 also of ``pin``. The tip is
``pin_length`` below the origin of ``pin``. The product of the poses along the chain gives the same
tip position as
:func:`rotemina.sim.kinematics.compute_tip_position`.
"""

from types import MappingProxyType

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics import NANO, KinematicChain

#: Path of each link, relative to the path of its ghost.
LINK_PATHS = MappingProxyType(
    {"x": "x", "y": "x/y", "z": "x/y/z", "tilt": "x/y/z/tilt", "pin": "x/y/z/tilt/pin"}
)


def compute_link_frames(joints: FloatArray) -> dict[str, FloatArray]:
    """Compute the pose (4, 4) of every link in the frame of the link before it.

    ``joints`` (6,) are the joint positions, m and rad.
    """
    poses = {link: np.eye(4) for link in LINK_PATHS}
    for index, link in enumerate(("x", "y", "z")):
        poses[link][index, 3] = joints[index]
    poses["tilt"][:3, :3] = _make_rotation(joints[4], 1) @ _make_rotation(joints[3], 0)
    poses["pin"][2, 3] = joints[5]
    return poses


def exaggerate_nano_motion(chain: KinematicChain, joints: FloatArray, factor: float) -> FloatArray:
    """Return a copy of joints (..., 6) with the nano stage ``factor`` times as far from its centre.

    The centre is the middle of the range of each nano axis.
    """
    exaggerated_joints = np.array(joints, dtype=float)
    centre = chain.centre[NANO]
    exaggerated_joints[..., NANO] = centre + factor * (exaggerated_joints[..., NANO] - centre)
    return exaggerated_joints


def _make_rotation(angle: float, axis: int) -> FloatArray:
    """Return the right-handed rotation (3, 3) by an angle, rad, about axis 0 (x) or 1 (y)."""
    cosine, sine = np.cos(angle), np.sin(angle)
    rotation = np.eye(3)
    first, second = ((1, 2), (2, 0))[axis]
    rotation[first, first] = rotation[second, second] = cosine
    rotation[first, second], rotation[second, first] = -sine, sine
    return rotation
