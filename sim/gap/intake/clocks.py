"""Check of the clocks of records: missing rows, varying intervals, periods that do not repeat."""

from collections.abc import Iterator

import numpy as np

from rotemina.sim.errors import GapError
from rotemina.sim.gap.intake.cautions import LabelledRecord, RecordCaution
from rotemina.sim.gap.intake.time_leaps import find_holes
from rotemina.sim.messages import format_rounded, message
from rotemina.sim.records import Tap

# A row is missing where an interval exceeds this many usual intervals.
_MISSING_ROW_INTERVALS = 1.5
# The middle 90 % of the intervals may spread by this fraction of the usual interval.
_MAX_INTERVAL_SPREAD_RATIO = 0.1
# The periods of a command may differ by this fraction of its span.
_MAX_PERIOD_CHANGE_RATIO = 0.01


def check_clock(labelled: LabelledRecord) -> Iterator[RecordCaution]:
    """Check the times of a piece of a record.

    Reading the record has already checked that times increase. Rows that are missing while all axes
    rest do no harm, because the commands are constant meanwhile.

    Raises
    ------
    GapError
        If a periodic record does not repeat its commands.
    """
    yield from _find_irregular_rows(labelled)
    _check_period(labelled)


def _find_irregular_rows(labelled: LabelledRecord) -> Iterator[RecordCaution]:
    intervals = np.diff(labelled.record.time_s)
    is_hole = find_holes(intervals)
    if is_hole.any():
        yield labelled.make_caution(
            message(
                "gap",
                "Rows are missing in a record for up to {time} s while no axis moves; the "
                "commands are assumed constant meanwhile.",
            ).fill(time=format_rounded(intervals[is_hole].max(), 3))
        )
    usual_s = float(np.median(intervals))
    low, high = np.percentile(intervals, [5.0, 95.0])
    if high - low > _MAX_INTERVAL_SPREAD_RATIO * usual_s:
        yield labelled.make_caution(
            message(
                "gap",
                "Rows of a record are {low} to {high} s apart; if a computer instead of the"
                " device took these times, their scatter appears as sensor noise.",
            ).fill(low=format_rounded(low, 3), high=format_rounded(high, 3))
        )
        return
    missing_count = int(np.sum((intervals > _MISSING_ROW_INTERVALS * usual_s) & ~is_hole))
    if missing_count:
        yield labelled.make_caution(
            message(
                "gap",
                "Rows are missing at {n} places of a record; the commands are assumed "
                "constant there.",
            ).fill(n=str(missing_count))
        )


def _check_period(labelled: LabelledRecord) -> None:
    record, period = labelled.record, labelled.record.period_samples
    if record.history != "periodic" or period is None or 2 * period > len(record.time_s):
        return
    for axis in record.axes:
        if not record.has(axis, Tap.CMD):
            continue
        command = record.signal(axis, Tap.CMD)
        change = np.abs(command[period:] - command[:-period])
        if float(change.max()) > _MAX_PERIOD_CHANGE_RATIO * float(np.ptp(command)):
            row = int(np.argmax(change)) + period
            raise GapError(
                "{name}: '# history: periodic' with period_samples = {period}, but {axis}.cmd "
                "at row {row} differs from its value one period earlier; correct "
                "period_samples, or write '# history: unknown'",
                name=labelled.name,
                period=period,
                axis=axis,
                row=row + 1,
            )
