"""Time leaps, which split a record into pieces, each with a separate history."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from rotemina.sim.arrays import (
    BoolArray,
    FloatArray,
    IntArray,
)
from rotemina.sim.errors import GapError
from rotemina.sim.gap.intake.cautions import LabelledRecord, RecordCaution
from rotemina.sim.messages import format_rounded, message
from rotemina.sim.records import Record, Tap

# A record, or a piece of one, needs this many rows.
MIN_ROWS = 100
# A time leap is longer than this many usual intervals, and longer than this many seconds.
_LEAP_INTERVALS = 10.0
_MIN_LEAP_S = 1.0
# Rows are lost in an interval that is longer than this many usual intervals, and longer than this
# many times the 95th percentile. The second condition allows for intervals that vary regularly.
_HOLE_INTERVALS = 5.0
_HOLE_SPREAD_RATIO = 3.0


def split_at_leaps(records: Sequence[Record], names: Sequence[str] = ()) -> list[LabelledRecord]:
    """Split records at time leaps.

    There is a leap where an interval exceeds both ten usual intervals and one second, or where rows
    are lost during motion. The model would hold the command in between and so differ from the
    machine without an error of either. The history of every piece but the first is unknown.

    Parameters
    ----------
    records : sequence of Record
    names : sequence of str, optional
        Names of the records in messages; by default their number, from 1, and length.

    Returns
    -------
    list of LabelledRecord
        Each piece has the number of its record. A record without a leap is one piece. Of a record
        with leaps, only pieces of 100 rows or more are returned.
    """
    labels = names or make_default_names(records)
    labelled = []
    for number, (record, name) in enumerate(zip(records, labels, strict=True)):
        slices = _find_contiguous_rows(record)
        for rows in slices:
            label = name
            if len(slices) > 1:
                label = message("gap", "{name}, rows {first} to {last}").fill(
                    name=name, first=rows.start + 1, last=rows.stop
                )
            if len(slices) == 1 or rows.stop - rows.start >= MIN_ROWS:
                labelled.append(LabelledRecord(_cut_piece(record, rows), label, number))
    return labelled


def make_default_names(records: Sequence[Record]) -> list[str]:
    """Return names by which messages can refer to records without names."""
    return [
        message("gap", "record {number} ({rows} rows, {duration} s)").fill(
            number=number, rows=len(record.time_s), duration=format_rounded(record.duration_s, 6)
        )
        for number, record in enumerate(records, start=1)
    ]


def _find_contiguous_rows(record: Record) -> list[slice]:
    ends = [0, *(_find_leaps(record) + 1), len(record.time_s)]
    return [slice(int(begin), int(end)) for begin, end in pairwise(ends)]


def _find_leaps(record: Record) -> IntArray:
    """Return the rows that are followed by a time leap."""
    intervals = np.diff(record.time_s)
    if len(intervals) == 0:
        return np.empty(0, dtype=np.intp)
    usual_s = float(np.median(intervals))
    leaps = (intervals > _LEAP_INTERVALS * usual_s) & (intervals > _MIN_LEAP_S)
    for row in np.flatnonzero(find_holes(intervals)):
        leaps[row] |= _is_moving_after(record, int(row))
    return np.flatnonzero(leaps)


def find_holes(intervals: FloatArray) -> BoolArray:
    """Return the intervals in which rows seem to be lost, and not only sparse."""
    median_s, percentile_95_s = np.percentile(intervals, [50.0, 95.0])
    return np.asarray(
        intervals > max(_HOLE_INTERVALS * median_s, _HOLE_SPREAD_RATIO * percentile_95_s)
    )


def _cut_piece(record: Record, rows: slice) -> Record:
    if rows.stop - rows.start == len(record.time_s):
        return record
    metadata = {key: value for key, value in record.metadata.items() if key != "period_samples"}
    if rows.start > 0 or record.history == "periodic":
        metadata["history"] = "unknown"
    return replace(record.select_rows(rows), metadata=metadata)


def check_leaps(records: Sequence[Record], names: Sequence[str]) -> Iterator[RecordCaution]:
    """Yield cautions about records that are split, and about rows that are omitted.

    Raises
    ------
    GapError
        If no piece of a record is long enough.
    """
    for number, (record, name) in enumerate(zip(records, names, strict=True)):
        leaps = _find_leaps(record)
        if len(leaps) == 0:
            continue
        rows = np.array([piece.stop - piece.start for piece in _find_contiguous_rows(record)])
        longest_s = np.diff(record.time_s)[leaps].max()
        if rows.max() < MIN_ROWS:
            raise GapError(
                "{name}: time jumps {count} ×, by up to {longest_s} s, and no piece between "
                "has more than {max} rows; a diagnosis needs {least_rows} or more without a "
                "jump: leave the record out, or record without losses",
                name=name,
                count=len(leaps),
                longest_s=format_rounded(longest_s, 3),
                max=rows.max(),
                least_rows=MIN_ROWS,
            )
        omitted_rows = rows[rows < MIN_ROWS].sum()
        omission = message("gap", "; {rows} rows in pieces shorter than {least} are omitted")
        text = message(
            "gap",
            "Time jumps {n} ×, by up to {time} s: the record is split there, and the "
            "history of each piece is unknown{left_out}.",
        ).fill(
            n=str(len(leaps)),
            time=format_rounded(longest_s, 3),
            left_out=omission.fill(rows=str(omitted_rows), least=str(MIN_ROWS))
            if omitted_rows
            else "",
        )
        yield RecordCaution(text, record=number)


def _is_moving_after(record: Record, row: int) -> bool:
    """Return whether the command of an axis keeps changing through the interval after ``row``.

    If the command only steps from one hold to the next, the record may be sparse on purpose.
    """
    for axis in record.axes:
        if record.has(axis, Tap.CMD):
            surrounding_commands = record.signal(axis, Tap.CMD)[max(row - 1, 0) : row + 3]
            interval_commands = record.signal(axis, Tap.CMD)[row : row + 2]
            if (
                np.diff(interval_commands).any()
                and np.count_nonzero(np.diff(surrounding_commands)) > 1
            ):
                return True
    return False
