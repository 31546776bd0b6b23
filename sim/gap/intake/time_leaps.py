"""Leaps of time, by which a record falls into pieces of a history of their own."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray, IntArray
from rotemina.sim.gap.errors import GapError
from rotemina.sim.gap.intake.cautions import Caution, Labelled
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded
from rotemina.sim.records.record import Record, Tap

LEAST_ROWS = 100  # of a record, and of a piece of one
_LEAP = 10.0  # usual intervals beyond which an interval is a leap of time
_LEAP_S = 1.0  # that a leap lasts longer than
_HOLE = 5.0  # usual intervals from which rows are lost if an axis is under way
_UNUSUAL = 3.0  # and times what 95 % of the intervals stay below, for those that vary by nature


def pieces(records: Sequence[Record], names: Sequence[str] = ()) -> list[Labelled]:
    """Return the pieces into which leaps of time split records.

    Time leaps where an interval exceeds ten usual ones and a second, or where rows are lost during
    motion: a model that holds the command meanwhile would differ from the machine without fault of
    either. The history of every piece but the first is unknown.

    Parameters
    ----------
    records : sequence of Record
    names : sequence of str, optional
        What messages call the records; by default their number, from 1, and length.

    Returns
    -------
    list of Labelled
        With the number of the record that a piece is of. A record without a leap is one piece;
        of one with leaps, only pieces of 100 rows or more.
    """
    called = names or default_names(records)
    found = []
    for number, (record, name) in enumerate(zip(records, called, strict=True)):
        slices = _contiguous(record)
        for rows in slices:
            label = name
            if len(slices) > 1:
                label = message("gap", "{name}, rows {first} to {last}").fill(
                    name=name, first=rows.start + 1, last=rows.stop
                )
            if len(slices) == 1 or rows.stop - rows.start >= LEAST_ROWS:
                found.append(Labelled(_piece(record, rows), label, number))
    return found


def default_names(records: Sequence[Record]) -> list[str]:
    """Return what messages call records without a name."""
    return [
        message("gap", "record {number} ({rows} rows, {duration} s)").fill(
            number=number, rows=len(record.time_s), duration=rounded(record.duration_s, 6)
        )
        for number, record in enumerate(records, start=1)
    ]


def _contiguous(record: Record) -> list[slice]:
    """Return the rows between leaps; all rows if there is no leap."""
    ends = [0, *(_leaps(record) + 1), len(record.time_s)]
    return [slice(int(begin), int(end)) for begin, end in pairwise(ends)]


def _leaps(record: Record) -> IntArray:
    """Return the rows behind which time leaps."""
    intervals = np.diff(record.time_s)
    if len(intervals) == 0:
        return np.empty(0, dtype=np.intp)
    usual = float(np.median(intervals))
    leaps = (intervals > _LEAP * usual) & (intervals > _LEAP_S)
    for row in np.flatnonzero(holes(intervals)):
        leaps[row] |= _under_way(record, int(row))
    return np.flatnonzero(leaps)


def holes(intervals: FloatArray) -> BoolArray:
    """Tell where rows seem to be lost, and are not just sparse by nature."""
    usual, long = np.percentile(intervals, [50.0, 95.0])
    return np.asarray(intervals > max(_HOLE * usual, _UNUSUAL * long))


def _piece(record: Record, rows: slice) -> Record:
    if rows.stop - rows.start == len(record.time_s):
        return record
    metadata = {key: value for key, value in record.metadata.items() if key != "period_samples"}
    if rows.start > 0 or record.history == "periodic":
        metadata["history"] = "unknown"
    return replace(record.part(rows), metadata=metadata)


def check_leaps(records: Sequence[Record], names: Sequence[str]) -> Iterator[Caution]:
    """Tell which records are taken in pieces, and what of them is left out.

    Raises
    ------
    GapError
        If no piece of a record is long enough.
    """
    for number, (record, name) in enumerate(zip(records, names, strict=True)):
        leaps = _leaps(record)
        if len(leaps) == 0:
            continue
        rows = np.array([piece.stop - piece.start for piece in _contiguous(record)])
        longest_s = np.diff(record.time_s)[leaps].max()
        if rows.max() < LEAST_ROWS:
            raise GapError(
                message(
                    "gap",
                    "{name}: time jumps {count} ×, by up to {longest_s} s, and no piece between "
                    "has more than {max} rows; a diagnosis needs {least_rows} or more without a "
                    "jump: leave the record out, or record without losses",
                ).fill(
                    name=name,
                    count=len(leaps),
                    longest_s=rounded(longest_s, 3),
                    max=rows.max(),
                    least_rows=LEAST_ROWS,
                )
            )
        short = rows[rows < LEAST_ROWS].sum()
        left_out = message("gap", "; {rows} rows in pieces shorter than {least} are omitted")
        said = message(
            "gap",
            "Time jumps {n} ×, by up to {time} s: the record is split there, and the "
            "history of each piece is unknown{left_out}.",
        ).fill(
            n=str(len(leaps)),
            time=rounded(longest_s, 3),
            left_out=left_out.fill(rows=str(short), least=str(LEAST_ROWS)) if short else "",
        )
        yield Caution(said, record=number)


def _under_way(record: Record, row: int) -> bool:
    """Tell whether an axis' command keeps changing through the interval after ``row``.

    A command that steps from hold to hold there may have been written sparsely on purpose.
    """
    for axis in record.axes:
        if record.has(axis, Tap.CMD):
            around = record.signal(axis, Tap.CMD)[max(row - 1, 0) : row + 3]
            across = record.signal(axis, Tap.CMD)[row : row + 2]
            if np.diff(across).any() and np.count_nonzero(np.diff(around)) > 1:
                return True
    return False
