"""A trajectory begun anywhere, and repeated."""

import numpy as np

from rotemina.sim.messages import message
from rotemina.sim.quantities import exact, rounded
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.trajectory.trajectory_excesses import TrajectoryError

MOST_TIMES, MOST_ROWS = 1000, 5_000_000
_CLOSED = 1e-9  # of an axis' stroke: ends that differ by less are the same


def part(trajectory: Record, *, begin_s: float = 0.0, times: int = 1) -> Record:
    """Return the commands from a time on, and then all of them again.

    Parameters
    ----------
    trajectory : Record
    begin_s : float
        Of its own time, from its first row: the first pass begins with the first row from there on.
    times : int
        How often it ends, 1 to ``MOST_TIMES``. The last row of a pass is the first of the next one.

    Raises
    ------
    TrajectoryError
        If the begin leaves less than two rows, it is to be repeated but does not end where it
        begins, or there would be more than ``MOST_ROWS`` rows.
    """
    time_s = trajectory.time_s - trajectory.time_s[0]
    if not 0.0 <= begin_s <= time_s[-2 if len(time_s) > 1 else -1]:
        raise TrajectoryError(
            message(
                "engine",
                "trajectory: it cannot begin at {begin_s} s: must be 0 to {time_s} s, before its "
                "last row",
            ).fill(
                begin_s=rounded(begin_s, 6),
                time_s=rounded(time_s[-2 if len(time_s) > 1 else -1], 6),
            )
        )
    if not 1 <= times <= MOST_TIMES:
        raise TrajectoryError(
            message("engine", "trajectory: repeated {times} times: must be 1 to {most_times}").fill(
                times=times, most_times=MOST_TIMES
            )
        )
    first = int(np.searchsorted(time_s, begin_s))
    rows = np.concatenate(
        [np.arange(first, len(time_s)), np.tile(np.arange(1, len(time_s)), times - 1)]
    )
    if len(rows) > MOST_ROWS:
        raise TrajectoryError(
            message(
                "engine",
                "trajectory: repeated {times} times it has {count} rows: at most {most_rows}; "
                "repeat it less often",
            ).fill(times=times, count=len(rows), most_rows=MOST_ROWS)
        )
    commands = {c.axis: trajectory.signal(*c) for c in trajectory.columns if c.tap is Tap.CMD}
    if times > 1:
        for axis, command in commands.items():
            apart = abs(float(command[-1] - command[0]))
            if apart > _CLOSED * float(np.ptp(command)):
                raise TrajectoryError(
                    message(
                        "engine",
                        "trajectory: axis {axis} ends {apart} from where it begins, so it "
                        "cannot be repeated; return to the start in its file",
                    ).fill(axis=axis, apart=exact(apart, trajectory.units[axis]))
                )
    passed = np.repeat(np.arange(times), [len(time_s) - first, *[len(time_s) - 1] * (times - 1)])
    return Record.from_signals(
        trajectory.time_s[0] + time_s[rows] + passed * time_s[-1] - time_s[first],
        {(axis, Tap.CMD): command[rows] for axis, command in commands.items()},
        trajectory.units,
        trajectory.metadata,
    )
