"""What an axis was doing when: the regimes over which a gap is split."""

from enum import StrEnum

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray

_AFTER_REVERSAL_S = 0.05
_SETTLING_S = 0.1  # after a step, before an axis counts as resting
_FAST = 0.5  # of the greatest speed of a record


class Regime(StrEnum):
    """What an axis or its neighbours were doing."""

    REST = "rest"
    SETTLING = "settling"
    REVERSAL = "reversal"
    FORWARD = "forward"
    BACKWARD = "backward"
    FAST = "fast"
    SLOW = "slow"
    OTHER_AXIS = "other axis moving"


def regimes(
    time_s: FloatArray, command: FloatArray, others_move: BoolArray
) -> dict[Regime, BoolArray]:
    """Return the rows (n,) of each regime; forward and fast overlap, rest and reversal do not.

    ``others_move`` (n,) tells where another axis was under way.
    """
    speed = np.gradient(command, time_s) if len(time_s) > 1 else np.zeros(len(time_s))
    moving = np.diff(command, prepend=command[0]) != 0.0
    since_move = _since(time_s, moving)
    turned = np.zeros(len(time_s), dtype=np.bool_)
    going = np.flatnonzero(moving)
    steps = np.sign(np.diff(command, prepend=command[0])[going])
    turned[going[1:][np.diff(steps) != 0.0]] = True
    reversal = _since(time_s, turned) < _AFTER_REVERSAL_S
    rest = since_move >= _SETTLING_S
    settling = ~moving & ~rest & ~reversal
    under_way = ~rest & ~reversal
    fast = np.abs(speed) > _FAST * float(np.abs(speed).max(initial=0.0))
    return {
        Regime.REST: rest & ~others_move,
        Regime.SETTLING: settling,
        Regime.REVERSAL: reversal,
        Regime.FORWARD: under_way & (speed > 0.0),
        Regime.BACKWARD: under_way & (speed < 0.0),
        Regime.FAST: under_way & fast,
        Regime.SLOW: under_way & ~fast,
        Regime.OTHER_AXIS: rest & others_move,
    }


def _since(time_s: FloatArray, happened: BoolArray) -> FloatArray:
    """Return the time (n,) since something last happened; infinite before it first did."""
    last = np.maximum.accumulate(np.where(happened, np.arange(len(time_s)), -1))
    since = np.full(len(time_s), np.inf)
    since[last >= 0] = (time_s - time_s[np.maximum(last, 0)])[last >= 0]
    return since
