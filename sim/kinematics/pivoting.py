"""Moves about a tip that stays: the tables make up for what the nano stage does.

A straight line between two joint positions keeps the tip at its ends only. In between it strays
by at most ``pin_length · turn² / 8`` (7 nm for the whole tilt range at 40 mm): paths with rows
close enough keep it as well as one likes.
"""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.chain import NANO, Chain
from rotemina.sim.kinematics.forward import tip_from_pivot, tip_position


def hold_tip(chain: Chain, joints: FloatArray, nano: FloatArray) -> FloatArray:
    """Return joints (..., 6) with ``nano`` (..., 3) thx, thy, zn and the tip of ``joints``.

    Raises
    ------
    OutOfLimitsError
        With axis, value and bounds, if a nano joint or a table making up for it leaves its range.
    """
    tables = tip_position(chain, joints) - tip_from_pivot(chain, nano)
    nano = np.broadcast_to(nano, tables.shape)
    return chain.check(np.concatenate([tables, nano], axis=-1))


def pivot(chain: Chain, joints: FloatArray, turn: FloatArray) -> FloatArray:
    """Turn thx, thy by ``turn`` (..., 2), rad, about the tip of ``joints`` (..., 6).

    A path is a ``turn`` of several rows, each counted from ``joints``.

    Raises
    ------
    OutOfLimitsError
        As :func:`hold_tip`.
    """
    extra = np.zeros((*np.shape(turn)[:-1], 1))
    return hold_tip(chain, joints, joints[..., NANO] + np.concatenate([turn, extra], axis=-1))


def recentre(chain: Chain, joints: FloatArray, nano: FloatArray | None = None) -> FloatArray:
    """Bring thx, thy, zn to ``nano`` (..., 3), else to mid-range, while the tip stays.

    Raises
    ------
    OutOfLimitsError
        As :func:`hold_tip`.
    """
    return hold_tip(chain, joints, chain.centre[NANO] if nano is None else nano)
