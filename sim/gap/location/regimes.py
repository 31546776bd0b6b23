"""What an axis was doing when, and where it was: the regimes over which a gap is split."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Self

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.robot.model import Axis, StepperAxis

_AFTER_REVERSAL_S = 0.05
_SETTLING_S = 0.1  # after a step, before an axis counts as resting
_FAST = 0.5  # of the greatest speed of a record
_LARGE = 0.5  # of the greatest swing of all records


class Regime(StrEnum):
    """What an axis or its neighbours were doing, how far it swung, and where it was."""

    REST = "rest"
    SETTLING = "settling"
    REVERSAL = "reversal"
    FORWARD = "forward"
    BACKWARD = "backward"
    FAST = "fast"
    SLOW = "slow"
    OTHER_AXIS = "other axis moving"
    LARGE_SWING = "large swing"
    SMALL_SWING = "small swing"
    LOW_END = "low end of travel"
    MIDDLE = "middle of travel"
    HIGH_END = "high end of travel"
    FIRST_QUARTER = "first quarter of a turn"
    SECOND_QUARTER = "second quarter of a turn"
    THIRD_QUARTER = "third quarter of a turn"
    LAST_QUARTER = "last quarter of a turn"


DOING = tuple(Regime)[: tuple(Regime).index(Regime.LARGE_SWING)]
_ENDS = (Regime.LOW_END, Regime.MIDDLE, Regime.HIGH_END)
_QUARTERS = (
    Regime.FIRST_QUARTER,
    Regime.SECOND_QUARTER,
    Regime.THIRD_QUARTER,
    Regime.LAST_QUARTER,
)


@dataclass(frozen=True, slots=True)
class Ways:
    """The travel of an axis in all records: its ends, and its largest swing, m or rad.

    ``turn`` is the travel per turn of its screw; None without a screw.
    """

    low: float
    high: float
    swing: float
    turn: float | None = None

    @classmethod
    def of(cls, commands: Sequence[FloatArray], axis: Axis | None = None) -> Self:
        """Gather the ways of an axis from its commands, each (n,)."""
        return cls(
            min(float(one.min()) for one in commands),
            max(float(one.max()) for one in commands),
            max(float(_swings(one).max(initial=0.0)) for one in commands),
            axis.pitch if isinstance(axis, StepperAxis) else None,
        )


def regimes(
    time_s: FloatArray, command: FloatArray, others_move: BoolArray, ways: Ways
) -> dict[Regime, BoolArray]:
    """Return the rows (n,) of each regime; forward and fast overlap, rest and reversal do not.

    ``others_move`` (n,) tells where another axis was moving. Swings count only during motion; ends
    of travel and quarters of a turn count at rest as well.
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
        **_by_swing(command, ways, ~rest),
        **_by_place(command, ways),
    }


def _by_swing(command: FloatArray, ways: Ways, under_way: BoolArray) -> dict[Regime, BoolArray]:
    large = _swings(command) >= _LARGE * ways.swing
    return {Regime.LARGE_SWING: under_way & large, Regime.SMALL_SWING: under_way & ~large}


def _by_place(command: FloatArray, ways: Ways) -> dict[Regime, BoolArray]:
    way = max(ways.high - ways.low, 1e-300)
    third = np.minimum(3.0 * (command - ways.low) / way, 2.0).astype(np.int64)
    found = {regime: third == number for number, regime in enumerate(_ENDS)}
    if ways.turn is not None and way >= ways.turn:
        quarter = np.floor(4.0 * np.mod(command / ways.turn, 1.0)).astype(np.int64)
        found |= {regime: quarter == number for number, regime in enumerate(_QUARTERS)}
    else:
        found |= {regime: np.zeros(len(command), dtype=np.bool_) for regime in _QUARTERS}
    return found


def _swings(command: FloatArray) -> FloatArray:
    """Return for each row (n,) how far the axis goes from one turning point to the next."""
    steps = np.diff(command)
    going = np.flatnonzero(steps)
    turns = going[1:][np.diff(np.sign(steps[going])) != 0.0]
    ends = np.concatenate([[0], turns, [len(command) - 1]]).astype(np.int64)
    rows = np.diff(ends)
    rows[-1] += 1
    return np.asarray(np.repeat(np.abs(np.diff(command[ends])), rows))


def _since(time_s: FloatArray, happened: BoolArray) -> FloatArray:
    """Return the time (n,) since something last happened; infinite before it first did."""
    last = np.maximum.accumulate(np.where(happened, np.arange(len(time_s)), -1))
    since = np.full(len(time_s), np.inf)
    since[last >= 0] = (time_s - time_s[np.maximum(last, 0)])[last >= 0]
    return since
