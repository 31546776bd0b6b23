"""Clocks of records: rows that are missing, and time that leaps."""

from collections.abc import Iterator

import numpy as np

from rotemina.sim.arrays import BoolArray
from rotemina.sim.gap.caution import Caution, Labelled
from rotemina.sim.gap.errors import GapError
from rotemina.sim.records.record import Record, Tap

_LEAP = 5.0  # usual intervals from which an interval is a leap of time
_UNUSUAL = 3.0  # and times what 95 % of the intervals stay below, for those that vary by nature
_LOST = 1.5  # usual intervals from which a row in between is missing
_UNEVEN = 0.1  # spread of the middle 90 % of intervals, over the usual one
_REPEATS = 0.01  # of a command's span, up to which its periods count as the same


def check_clock(one: Labelled) -> Iterator[Caution]:
    """Check the times of a record; that they increase was found when it was read.

    A leap of time while an axis is under way is refused: a model that holds the command through it
    would part from the machine for no fault of either. While all axes rest it does no harm.

    Raises
    ------
    GapError
        If time leaps under way, or a periodic record does not repeat its commands.
    """
    record = one.record
    intervals = np.diff(record.time_s)
    usual = float(np.median(intervals))
    least = max(_LEAP * usual, _UNUSUAL * float(np.percentile(intervals, 95.0)))
    leaps = np.flatnonzero(intervals > least)
    moving = [row for row in leaps if _under_way(record, int(row)) is not None]
    if moving:
        row = int(moving[0])
        raise GapError(
            f"{one.name}: time leaps by {intervals[row]:.6g} s behind row {row + 1} "
            f"(t = {record.time_s[row]:.9g} s), where rows are {usual:.6g} s apart, while axis "
            f"{_under_way(record, row)!r} is under way{_others(len(moving))}: rows are lost or the "
            "clock was set; split the record there, with '# history: unknown' in the second part"
        )
    if len(leaps):
        yield one.caution(
            f"Time leaps {len(leaps)} times in a record, by up to {intervals.max():.3g} s, where "
            "no axis is under way; the commands are taken as held meanwhile."
        )
    yield from _unsteady(one, intervals > least)
    _check_period(one)


def _others(count: int) -> str:
    return f" (and {count - 1} more such leaps)" if count > 1 else ""


def _under_way(record: Record, row: int) -> str | None:
    """Return an axis whose command goes on changing through the interval behind ``row``.

    One that steps from hold to hold there may have been written sparsely on purpose.
    """
    for axis in record.axes:
        if record.has(axis, Tap.CMD):
            around = record.signal(axis, Tap.CMD)[max(row - 1, 0) : row + 3]
            across = record.signal(axis, Tap.CMD)[row : row + 2]
            if np.diff(across).any() and np.count_nonzero(np.diff(around)) > 1:
                return axis
    return None


def _unsteady(one: Labelled, leaps: BoolArray) -> Iterator[Caution]:
    """Tell of single rows that are missing, or of intervals that vary throughout."""
    intervals = np.diff(one.record.time_s)
    usual = float(np.median(intervals))
    low, high = np.percentile(intervals, [5.0, 95.0])
    if high - low > _UNEVEN * usual:
        yield one.caution(
            f"Rows of a record are {low:.3g} to {high:.3g} s apart; if these are times of a "
            "computer and not of the device, their scatter passes for noise of the sensors."
        )
        return
    lost = int(np.sum((intervals > _LOST * usual) & ~leaps))
    if lost:
        yield one.caution(
            f"Rows are missing at {lost} places of a record; the commands are taken as held there."
        )


def _check_period(one: Labelled) -> None:
    record, period = one.record, one.record.period_samples
    if record.history != "periodic" or period is None or 2 * period > len(record.time_s):
        return
    for axis in record.axes:
        if not record.has(axis, Tap.CMD):
            continue
        command = record.signal(axis, Tap.CMD)
        off = np.abs(command[period:] - command[:-period])
        if float(off.max()) > _REPEATS * float(np.ptp(command)):
            row = int(np.argmax(off)) + period
            raise GapError(
                f"{one.name}: '# history: periodic' with period_samples = {period}, but {axis}.cmd "
                f"at row {row + 1} is not what it was a period before; correct period_samples, or "
                "write '# history: unknown'"
            )
