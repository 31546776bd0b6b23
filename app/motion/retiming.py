"""The same path at another pace: a speed factor, and a smooth start in mid-path."""

from dataclasses import dataclass, replace

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded
from rotemina.sim.records.record import Record

SLOWEST, FASTEST = 0.01, 10.0
EASING_S = 0.5  # from standing to the full pace, in the middle of a path
_DENSE = 2.0  # set-point periods: rows farther apart are places to go to, not points of a curve


@dataclass(frozen=True, slots=True, eq=False)
class Piece:
    """The played part of a trajectory, and the mapping of its times to the whole.

    Attributes
    ----------
    trajectory : Record
        Times from 0.
    path_s : (n,)
        Time in the whole trajectory, from its first row, of each row of the piece.
    """

    trajectory: Record
    path_s: FloatArray

    def path_time(self, elapsed_s: float) -> float:
        """Return the time in the whole trajectory so long after the piece's first row, s."""
        return float(np.interp(elapsed_s, self.trajectory.time_s, self.path_s))


def check_speed(speed: float) -> float:
    """Return a speed factor that is one.

    Raises
    ------
    InputError
        If it is not between 0.01 and 10.
    """
    if not SLOWEST <= speed <= FASTEST:
        raise InputError(
            message(
                "engine",
                "playback: the speed {speed} must be {slowest} to {fastest} times that of "
                "the trajectory",
            ).fill(
                speed=rounded(speed, 6), slowest=rounded(SLOWEST, 6), fastest=rounded(FASTEST, 6)
            )
        )
    return speed


def piece(
    trajectory: Record, *, row: int = 0, speed: float = 1.0, setpoint_period_s: float
) -> Piece:
    """Return the rows from ``row`` on, ``speed`` times as fast.

    A piece that starts in the middle of a curve (rows no farther apart than two set-points) starts
    gently: its pace rises evenly from 0 to full over half a second, ``p(τ) = τ²/2T`` up to T, so
    the speed has no jump. For that its rows are joined by lines at the device's set-points.

    Raises
    ------
    InputError
        If the speed or the row is none.
    """
    check_speed(speed)
    rows = len(trajectory.time_s)
    if not 0 <= row < rows:
        raise InputError(
            message("engine", "playback: row {row}: the trajectory has rows 0 to {rows}").fill(
                row=row, rows=rows - 1
            )
        )
    path_s = trajectory.time_s - trajectory.time_s[0]
    rest = trajectory.part(slice(row, None))
    path_s = path_s[row:]
    elapsed_s = (path_s - path_s[0]) / speed
    whole = Piece(replace(rest, time_s=elapsed_s), path_s)
    if row == 0 or len(elapsed_s) < 2:
        return whole
    dense = float(np.diff(elapsed_s).max()) <= _DENSE * setpoint_period_s
    return _eased(whole, speed, setpoint_period_s) if dense else whole


def _eased(whole: Piece, speed: float, period_s: float) -> Piece:
    """Let a piece begin at rest, with rows at the device's set-points."""
    record = whole.trajectory
    rise_s = min(EASING_S, record.duration_s)
    length_s = record.duration_s + 0.5 * rise_s
    elapsed_s = np.arange(np.floor(length_s / period_s) + 1.0) * period_s
    if length_s - elapsed_s[-1] > 1e-3 * period_s:
        elapsed_s = np.append(elapsed_s, elapsed_s[-1] + period_s)
    at_full_pace = elapsed_s - 0.5 * rise_s
    eased_s = np.where(elapsed_s < rise_s, elapsed_s**2 / (2.0 * rise_s), at_full_pace)
    within_s = np.minimum(eased_s, record.duration_s)
    values = np.column_stack(
        [np.interp(within_s, record.time_s, column) for column in record.values.T]
    )
    eased = replace(record, time_s=elapsed_s, values=values)
    return Piece(eased, whole.path_s[0] + speed * within_s)
