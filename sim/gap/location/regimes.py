"""Operating regimes by which a gap is split: what the axis was doing, and where it was."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Self

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.robot import Axis, StepperAxis

# A reversal lasts this long after the direction of the command changes.
_REVERSAL_DURATION_S = 0.05
# An axis counts as resting from this time after its command has stopped.
_SETTLING_TIME_S = 0.1
# An axis is fast above this fraction of the maximum speed of the record.
_MIN_FAST_SPEED_RATIO = 0.5
# A swing is large above this fraction of the largest swing in all records.
_MIN_LARGE_SWING_RATIO = 0.5


class OperatingRegime(StrEnum):
    """The activity of an axis or of other axes, the size of a swing, or the position."""

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


ACTIVITY_REGIMES = tuple(OperatingRegime)[
    : tuple(OperatingRegime).index(OperatingRegime.LARGE_SWING)
]
_TRAVEL_THIRDS = (OperatingRegime.LOW_END, OperatingRegime.MIDDLE, OperatingRegime.HIGH_END)
_TURN_QUARTERS = (
    OperatingRegime.FIRST_QUARTER,
    OperatingRegime.SECOND_QUARTER,
    OperatingRegime.THIRD_QUARTER,
    OperatingRegime.LAST_QUARTER,
)


@dataclass(frozen=True, slots=True)
class AxisTravel:
    """The travel of an axis in all records: its ends and its largest swing, m or rad.

    ``turn`` is the travel per turn of the screw; None if there is no screw.
    """

    low: float
    high: float
    swing: float
    turn: float | None = None

    @classmethod
    def of(cls, commands: Sequence[FloatArray], axis: Axis | None = None) -> Self:
        """Return the travel of an axis from its commands, each (n,)."""
        return cls(
            min(float(command.min()) for command in commands),
            max(float(command.max()) for command in commands),
            max(float(_find_swings(command).max(initial=0.0)) for command in commands),
            axis.pitch if isinstance(axis, StepperAxis) else None,
        )


def find_regimes(
    time_s: FloatArray, command: FloatArray, others_move: BoolArray, travel: AxisTravel
) -> dict[OperatingRegime, BoolArray]:
    """Return the rows (n,) of each regime.

    Regimes may overlap, such as forward and fast. ``others_move`` (n,) is true where another axis
    moves. Rows count for a swing only during motion, but for an end of travel or a quarter of a
    turn also at rest.
    """
    speed = np.gradient(command, time_s) if len(time_s) > 1 else np.zeros(len(time_s))
    is_moving = np.diff(command, prepend=command[0]) != 0.0
    time_since_move_s = _compute_time_since(time_s, is_moving)
    is_reversal_row = np.zeros(len(time_s), dtype=np.bool_)
    moving_rows = np.flatnonzero(is_moving)
    steps = np.sign(np.diff(command, prepend=command[0])[moving_rows])
    is_reversal_row[moving_rows[1:][np.diff(steps) != 0.0]] = True
    is_reversing = _compute_time_since(time_s, is_reversal_row) < _REVERSAL_DURATION_S
    is_resting = time_since_move_s >= _SETTLING_TIME_S
    is_settling = ~is_moving & ~is_resting & ~is_reversing
    is_travelling = ~is_resting & ~is_reversing
    is_fast = np.abs(speed) > _MIN_FAST_SPEED_RATIO * float(np.abs(speed).max(initial=0.0))
    return {
        OperatingRegime.REST: is_resting & ~others_move,
        OperatingRegime.SETTLING: is_settling,
        OperatingRegime.REVERSAL: is_reversing,
        OperatingRegime.FORWARD: is_travelling & (speed > 0.0),
        OperatingRegime.BACKWARD: is_travelling & (speed < 0.0),
        OperatingRegime.FAST: is_travelling & is_fast,
        OperatingRegime.SLOW: is_travelling & ~is_fast,
        OperatingRegime.OTHER_AXIS: is_resting & others_move,
        **_split_by_swing(command, travel, ~is_resting),
        **_split_by_position(command, travel),
    }


def _split_by_swing(
    command: FloatArray, travel: AxisTravel, is_moving: BoolArray
) -> dict[OperatingRegime, BoolArray]:
    is_large = _find_swings(command) >= _MIN_LARGE_SWING_RATIO * travel.swing
    return {
        OperatingRegime.LARGE_SWING: is_moving & is_large,
        OperatingRegime.SMALL_SWING: is_moving & ~is_large,
    }


def _split_by_position(command: FloatArray, travel: AxisTravel) -> dict[OperatingRegime, BoolArray]:
    span = max(travel.high - travel.low, 1e-300)
    third = np.minimum(3.0 * (command - travel.low) / span, 2.0).astype(np.int64)
    by_regime = {regime: third == number for number, regime in enumerate(_TRAVEL_THIRDS)}
    if travel.turn is not None and span >= travel.turn:
        quarter = np.floor(4.0 * np.mod(command / travel.turn, 1.0)).astype(np.int64)
        by_regime |= {regime: quarter == number for number, regime in enumerate(_TURN_QUARTERS)}
    else:
        by_regime |= {regime: np.zeros(len(command), dtype=np.bool_) for regime in _TURN_QUARTERS}
    return by_regime


def _find_swings(command: FloatArray) -> FloatArray:
    """Return for each row (n,) the distance between the turning points before and after it."""
    steps = np.diff(command)
    moving_steps = np.flatnonzero(steps)
    turning_rows = moving_steps[1:][np.diff(np.sign(steps[moving_steps])) != 0.0]
    swing_ends = np.concatenate([[0], turning_rows, [len(command) - 1]]).astype(np.int64)
    rows = np.diff(swing_ends)
    rows[-1] += 1
    return np.asarray(np.repeat(np.abs(np.diff(command[swing_ends])), rows))


def _compute_time_since(time_s: FloatArray, is_event: BoolArray) -> FloatArray:
    """Return the time (n,) since ``is_event`` was last true; infinite before the first event."""
    last_event_row = np.maximum.accumulate(np.where(is_event, np.arange(len(time_s)), -1))
    time_since_s = np.full(len(time_s), np.inf)
    time_since_s[last_event_row >= 0] = (time_s - time_s[np.maximum(last_event_row, 0)])[
        last_event_row >= 0
    ]
    return time_since_s
