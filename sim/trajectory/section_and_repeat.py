"""Sections and repetitions of a trajectory."""

import numpy as np

from rotemina.sim.errors import TrajectoryError
from rotemina.sim.messages import format_rounded
from rotemina.sim.records import Record, Tap
from rotemina.sim.units import format_exact

MAX_REPEATS, MAX_ROWS = 1000, 5_000_000
# The ends of a trajectory are equal if they differ by less than this fraction of the axis' travel.
_CLOSURE_TOLERANCE_RATIO = 1e-9


def cut_and_repeat(trajectory: Record, *, begin_s: float = 0.0, times: int = 1) -> Record:
    """Return the commands from ``begin_s`` on, followed by repetitions of the whole trajectory.

    Parameters
    ----------
    trajectory : Record
    begin_s : float
        Time since the first row. The first pass begins with the first row at or after it.
    times : int
        Number of passes, 1 to ``MAX_REPEATS``. The last row of a pass is the first of the next one.

    Raises
    ------
    TrajectoryError
        If fewer than two rows remain, if a repeated trajectory does not end where it begins, or if
        the result has more than ``MAX_ROWS`` rows.
    """
    time_s = trajectory.time_s - trajectory.time_s[0]
    if not 0.0 <= begin_s <= time_s[-2 if len(time_s) > 1 else -1]:
        raise TrajectoryError(
            "trajectory: it cannot begin at {begin_s} s; choose a time from 0 to {time_s} s, "
            "before the last row",
            begin_s=format_rounded(begin_s, 6),
            time_s=format_rounded(time_s[-2 if len(time_s) > 1 else -1], 6),
        )
    if not 1 <= times <= MAX_REPEATS:
        raise TrajectoryError(
            "trajectory: repeated {times} times: must be 1 to {most_times}",
            times=times,
            most_times=MAX_REPEATS,
        )
    first_row = int(np.searchsorted(time_s, begin_s))
    rows = np.concatenate(
        [np.arange(first_row, len(time_s)), np.tile(np.arange(1, len(time_s)), times - 1)]
    )
    if len(rows) > MAX_ROWS:
        raise TrajectoryError(
            "trajectory: repeated {times} times, it has {count} rows (at most {most_rows}); "
            "repeat it less often",
            times=times,
            count=len(rows),
            most_rows=MAX_ROWS,
        )
    commands = {
        channel.axis: trajectory.signal(*channel)
        for channel in trajectory.columns
        if channel.tap is Tap.CMD
    }
    if times > 1:
        for axis, command in commands.items():
            distance = abs(float(command[-1] - command[0]))
            if distance > _CLOSURE_TOLERANCE_RATIO * float(np.ptp(command)):
                raise TrajectoryError(
                    "trajectory: axis {axis} ends {apart} from where it begins, so it "
                    "cannot be repeated; return to the start in its file",
                    axis=axis,
                    apart=format_exact(distance, trajectory.units[axis]),
                )
    pass_number = np.repeat(
        np.arange(times), [len(time_s) - first_row, *[len(time_s) - 1] * (times - 1)]
    )
    return Record.from_signals(
        trajectory.time_s[0] + time_s[rows] + pass_number * time_s[-1] - time_s[first_row],
        {(axis, Tap.CMD): command[rows] for axis, command in commands.items()},
        trajectory.units,
        trajectory.metadata,
    )
