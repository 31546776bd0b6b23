"""Moves about a fixed tip: the tables compensate for the motion of the nano stage.

A straight line between two joint positions keeps the tip exactly in place only at its ends. In
between, the tip deviates by at most ``pin_length · turn² / 8`` (7 nm for the whole tilt range at
40 mm). A path with closer rows has a smaller deviation.
"""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.chain import NANO, KinematicChain
from rotemina.sim.kinematics.forward import compute_tip_from_pivot, compute_tip_position


def hold_tip(chain: KinematicChain, joints: FloatArray, nano: FloatArray) -> FloatArray:
    """Return joints (..., 6) with thx, thy, zn from ``nano`` (..., 3) and the tip of ``joints``.

    Raises
    ------
    OutOfLimitsError
        If a nano joint or a table leaves its range. The message names axis, value and bounds.
    """
    tables = compute_tip_position(chain, joints) - compute_tip_from_pivot(chain, nano)
    nano = np.broadcast_to(nano, tables.shape)
    return chain.check(np.concatenate([tables, nano], axis=-1))


def pivot(chain: KinematicChain, joints: FloatArray, turn: FloatArray) -> FloatArray:
    """Turn thx, thy by ``turn`` (..., 2), rad, about the tip of ``joints`` (..., 6).

    For a path, ``turn`` has several rows, each relative to ``joints``.

    Raises
    ------
    OutOfLimitsError
        As :func:`hold_tip`.
    """
    zn_change = np.zeros((*np.shape(turn)[:-1], 1))
    return hold_tip(chain, joints, joints[..., NANO] + np.concatenate([turn, zn_change], axis=-1))


def recentre(
    chain: KinematicChain, joints: FloatArray, nano: FloatArray | None = None
) -> FloatArray:
    """Return joints with thx, thy, zn at ``nano`` (..., 3), or at mid-range, and the same tip.

    Raises
    ------
    OutOfLimitsError
        As :func:`hold_tip`.
    """
    return hold_tip(chain, joints, chain.centre[NANO] if nano is None else nano)
