"""Clocks of records: rows that are missing, intervals that vary, periods that do not repeat."""

from collections.abc import Iterator

import numpy as np

from rotemina.sim.gap.errors import GapError
from rotemina.sim.gap.intake.cautions import Caution, Labelled
from rotemina.sim.gap.intake.time_leaps import holes
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded
from rotemina.sim.records.record import Tap

_LOST = 1.5  # usual intervals from which a row in between is missing
_UNEVEN = 0.1  # spread of the middle 90 % of intervals, over the usual one
_REPEATS = 0.01  # of a command's span, up to which its periods count as the same


def check_clock(one: Labelled) -> Iterator[Caution]:
    """Check the times of a piece of a record; that they increase was found when it was read.

    Rows that are missing while all axes rest do no harm: the commands are held meanwhile.

    Raises
    ------
    GapError
        If a periodic record does not repeat its commands.
    """
    yield from _unsteady(one)
    _check_period(one)


def _unsteady(one: Labelled) -> Iterator[Caution]:
    """Tell of rows that are missing, or of intervals that vary throughout."""
    intervals = np.diff(one.record.time_s)
    missing = holes(intervals)
    if missing.any():
        yield one.caution(
            message(
                "gap",
                "Rows are missing in a record for up to {time} s while no axis moves; the "
                "commands are assumed constant meanwhile.",
            ).fill(time=rounded(intervals[missing].max(), 3))
        )
    usual = float(np.median(intervals))
    low, high = np.percentile(intervals, [5.0, 95.0])
    if high - low > _UNEVEN * usual:
        yield one.caution(
            message(
                "gap",
                "Rows of a record are {low} to {high} s apart; if a computer instead of the"
                " device took these times, their scatter appears as sensor noise.",
            ).fill(low=rounded(low, 3), high=rounded(high, 3))
        )
        return
    lost = int(np.sum((intervals > _LOST * usual) & ~missing))
    if lost:
        yield one.caution(
            message(
                "gap",
                "Rows are missing at {n} places of a record; the commands are assumed "
                "constant there.",
            ).fill(n=str(lost))
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
                message(
                    "gap",
                    "{name}: '# history: periodic' with period_samples = {period}, but {axis}.cmd "
                    "at row {row} is not what it was a period before; correct period_samples, or "
                    "write '# history: unknown'",
                ).fill(name=one.name, period=period, axis=axis, row=row + 1)
            )
