"""Export of record and trajectory files."""

import gzip
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from itertools import chain
from os import PathLike, fspath
from typing import BinaryIO, cast

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded
from rotemina.sim.records.file_blocks import LIMITS
from rotemina.sim.records.layout import Column, Layout, check_axis_name, check_commands
from rotemina.sim.records.metadata import comment_lines
from rotemina.sim.records.record import VOLTAGE_TAPS, Record, RecordError
from rotemina.sim.units import UnitError, canonical, quantity
from rotemina.sim.whole_files import FileWriteError, replaced

_ROWS_AT_A_TIME = 65_536
_COMPRESSION = 6


def write_record(
    record: Record,
    path: str | PathLike[str],
    *,
    units: Mapping[str, str] | None = None,
    header: bool = True,
) -> None:
    """Export a record with commas, ``.`` and as many digits as float64 needs to come back.

    The file appears whole or not at all: it is written beside its place and then renamed, over a
    file that is there already.

    Parameters
    ----------
    record : what to write.
    path : of the file; compressed if the name ends in ``.gz``.
    units : mapping axis -> unit of its positions, such as ``{"x": "um"}``; SI where left out.
    header : whether to write the metadata and the header row, or numbers alone.

    Raises
    ------
    RecordError
        If the file cannot be written, a unit does not fit, or the record would not read back.
    """
    write_pieces([record], path, units=units, header=header)


def write_pieces(
    pieces: Iterable[Record],
    path: str | PathLike[str],
    *,
    units: Mapping[str, str] | None = None,
    header: bool = True,
) -> None:
    """Export a record that comes in pieces, one behind the other, as :func:`write_record` does.

    The metadata are those of the first piece. Where a piece fails to come, no file is left.

    Raises
    ------
    RecordError
        As of :func:`write_record`; if there is no piece, or one does not continue where the one
        before ended.
    """
    coming = iter(pieces)
    first = next(coming, None)
    if first is None:
        raise RecordError(message("engine", "record: it holds no rows"))
    layout = _layout(first, units or {})
    head = _head(first, layout) if header else b""
    last_s = -np.inf
    with open_export(fspath(path)) as file:
        file.write(head)
        for piece in chain([first], coming):
            _check_goes_on(first, piece, last_s)
            last_s = float(piece.time_s[-1])
            for start in range(0, len(piece.time_s), _ROWS_AT_A_TIME):
                _write_rows(file, piece, layout, slice(start, start + _ROWS_AT_A_TIME))


def _check_goes_on(first: Record, piece: Record, last_s: float) -> None:
    if (piece.columns, piece.units) != (first.columns, first.units):
        raise RecordError(
            message(
                "engine", "record: the piece from t = {time_s} s has other columns than the first"
            ).fill(time_s=rounded(piece.time_s[0], 9))
        )
    if piece.time_s[0] <= last_s:
        raise RecordError(
            message(
                "engine",
                "record: the piece from t = {time_s} s does not follow the previous one, "
                "which ends at t = {last_s} s",
            ).fill(time_s=rounded(piece.time_s[0], 9), last_s=rounded(last_s, 9))
        )


def _layout(record: Record, units: Mapping[str, str]) -> Layout:
    check_commands(record.columns, "record")
    for axis in record.axes:
        check_axis_name(axis, "record")
    for axis, unit in units.items():
        _check_unit(record, axis, unit)
    columns = [Column(None, "s")]
    for channel in record.columns:
        si_unit = "V" if channel.tap in VOLTAGE_TAPS else record.units[channel.axis]
        wanted = si_unit if si_unit == "V" else canonical(units.get(channel.axis, si_unit))
        columns.append(Column(channel, wanted))
    return Layout(",", tuple(columns))


def _check_unit(record: Record, axis: str, unit: str) -> None:
    if axis not in record.axes:
        raise RecordError(
            message("engine", "units: the record has no axis {axis}; its axes are {names}").fill(
                axis=repr(axis), names=" ".join(record.axes)
            )
        )
    try:
        kind = quantity(unit)
    except UnitError as error:
        raise RecordError(
            message("engine", "units:{axis}: {error}").fill(axis=axis, error=str(error))
        ) from error
    if kind != record.units[axis]:
        raise RecordError(
            message(
                "engine", "units:{axis}: {unit} cannot show units of {units}; use one of those"
            ).fill(axis=axis, unit=repr(unit), units=record.units[axis])
        )


def _head(record: Record, layout: Layout) -> bytes:
    headings = ",".join(column.heading for column in layout.columns)
    lines = [*comment_lines(record.metadata, LIMITS.line_bytes), headings]
    return "".join(line + "\n" for line in lines).encode()


def _write_rows(file: BinaryIO, record: Record, layout: Layout, rows: slice) -> None:
    import polars as pl  # takes its time to import; a window that exports nothing goes without

    signals = [record.time_s[rows], *record.values[rows].T]
    table = pl.DataFrame(
        {
            str(index): _converted(signal, column, factor)
            for index, (signal, column, factor) in enumerate(
                zip(signals, layout.columns, layout.per_si, strict=True)
            )
        }
    )
    table.write_csv(file, include_header=False)


def _converted(signal: FloatArray, column: Column, factor: float) -> FloatArray:
    if factor == 1.0:
        return np.ascontiguousarray(signal)
    with np.errstate(over="ignore"):
        values = signal * factor
    if not np.isfinite(values).all():
        raise RecordError(
            message("engine", "record:{column}: too large for [{unit}]; choose a larger unit").fill(
                column=str(column), unit=column.unit
            )
        )
    return values


@contextmanager
def open_export(name: str) -> Iterator[BinaryIO]:
    """Open the file that takes the place of ``name`` when it is complete.

    What is written is compressed if the name ends in ``.gz``.

    Raises
    ------
    RecordError
        If it cannot be written.
    """
    try:
        with replaced(name) as file:
            if name.endswith(".gz"):
                with gzip.GzipFile("", "wb", _COMPRESSION, file, mtime=0) as compressed:
                    yield cast(BinaryIO, compressed)
            else:
                yield file
    except FileWriteError as error:
        raise RecordError(str(error)) from error
