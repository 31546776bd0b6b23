"""Frames of the chain: the pose of each link in the one that carries it.

x carries y carries z carries the tilting plate (thx, thy) carries the pin (zn)::

    base → x: along x → y: along y → z: along z → tilt: R_y(thy) R_x(thx) → pin: zn along its z

The origin of ``z``, ``tilt`` and, at zn = 0, ``pin`` is the pivot; the tip is ``pin_length`` below
the origin of ``pin``. Multiplied along the chain that is the tip of
:func:`rotemina.sim.kinematics.forward.tip_position`.
"""

from types import MappingProxyType

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.chain import NANO, Chain

#: Each link, with its path below a ghost's own.
LINKS = MappingProxyType(
    {"x": "x", "y": "x/y", "z": "x/y/z", "tilt": "x/y/z/tilt", "pin": "x/y/z/tilt/pin"}
)


def frames(joints: FloatArray) -> dict[str, FloatArray]:
    """Return the matrix (4, 4) of every link in its carrier's frame, for joints (6,)."""
    placed = {link: np.eye(4) for link in LINKS}
    for index, link in enumerate(("x", "y", "z")):
        placed[link][index, 3] = joints[index]
    placed["tilt"][:3, :3] = _turn(joints[4], 1) @ _turn(joints[3], 0)
    placed["pin"][2, 3] = joints[5]
    return placed


def exaggerated(chain: Chain, joints: FloatArray, factor: float) -> FloatArray:
    """Return joints (..., 6) with the nano stage ``factor`` times as far from its mid-range."""
    stretched = np.array(joints, dtype=float)
    middle = chain.centre[NANO]
    stretched[..., NANO] = middle + factor * (stretched[..., NANO] - middle)
    return stretched


def _turn(angle: float, about: int) -> FloatArray:
    """Return the right-handed rotation (3, 3) about axis 0 (x) or 1 (y), rad."""
    cosine, sine = np.cos(angle), np.sin(angle)
    turn = np.eye(3)
    one, other = ((1, 2), (2, 0))[about]
    turn[one, one] = turn[other, other] = cosine
    turn[one, other], turn[other, one] = -sine, sine
    return turn
