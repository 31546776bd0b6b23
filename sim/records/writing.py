"""Writing of record and trajectory files."""

import gzip
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from itertools import chain
from os import PathLike, fspath
from typing import BinaryIO, cast

import numpy as np
import orjson

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import FileWriteError, RecordError, UnitError
from rotemina.sim.files import replace_file
from rotemina.sim.messages import format_rounded
from rotemina.sim.records.file_blocks import DEFAULT_LIMITS
from rotemina.sim.records.layout import FileColumn, FileLayout, check_axis_name, check_commands
from rotemina.sim.records.metadata import format_comments
from rotemina.sim.records.record import VOLTAGE_TAPS, Record
from rotemina.sim.units import parse_unit, si_unit_of

_MAX_ROWS_PER_WRITE = 65_536
# Formatting a number takes 0.1 µs, during which no other thread runs.
_MAX_VALUES_PER_TEXT = 4096
_COMPRESSION_LEVEL = 6


def write_record(
    record: Record,
    path: str | PathLike[str],
    *,
    units: Mapping[str, str] | None = None,
    header: bool = True,
) -> None:
    """Write a record with commas as separators and enough digits to read back each float64 exactly.

    The file is written atomically: under another name, and then renamed. An existing file is
    replaced.

    Parameters
    ----------
    record : the record.
    path : of the file. It is compressed if the name ends in ``.gz``.
    units : mapping axis -> unit of its positions, such as ``{"x": "um"}``; SI by default.
    header : whether to write the metadata and the header row before the numbers.

    Raises
    ------
    RecordError
        If the file cannot be written, a unit does not fit, or the record could not be read back.
    """
    write_pieces([record], path, units=units, header=header)


def write_pieces(
    pieces: Iterable[Record],
    path: str | PathLike[str],
    *,
    units: Mapping[str, str] | None = None,
    header: bool = True,
) -> None:
    """Write a record that is given in consecutive pieces, like :func:`write_record`.

    The metadata are those of the first piece. If producing a piece fails, no file remains.

    Raises
    ------
    RecordError
        As in :func:`write_record`. Also if there is no piece, or a piece does not continue the
        previous one.
    """
    remaining = iter(pieces)
    first = next(remaining, None)
    if first is None:
        raise RecordError("record: it holds no rows")
    layout = _make_layout(first, units or {})
    header_text = _format_header(first, layout) if header else b""
    last_s = -np.inf
    with open_export(fspath(path)) as file:
        file.write(header_text)
        for piece in chain([first], remaining):
            _check_continuity(first, piece, last_s)
            last_s = float(piece.time_s[-1])
            for start in range(0, len(piece.time_s), _MAX_ROWS_PER_WRITE):
                _write_rows(file, piece, layout, slice(start, start + _MAX_ROWS_PER_WRITE))


def _check_continuity(first: Record, piece: Record, last_s: float) -> None:
    if (piece.columns, piece.units) != (first.columns, first.units):
        raise RecordError(
            "record: the piece from t = {time_s} s has other columns than the first",
            time_s=format_rounded(piece.time_s[0], 9),
        )
    if piece.time_s[0] <= last_s:
        raise RecordError(
            "record: the piece from t = {time_s} s does not follow the previous one, "
            "which ends at t = {last_s} s",
            time_s=format_rounded(piece.time_s[0], 9),
            last_s=format_rounded(last_s, 9),
        )


def _make_layout(record: Record, units: Mapping[str, str]) -> FileLayout:
    check_commands(record.columns, "record")
    for axis in record.axes:
        check_axis_name(axis, "record")
    for axis, unit in units.items():
        _check_unit(record, axis, unit)
    columns = [FileColumn(None, "s")]
    for channel in record.columns:
        si_unit = "V" if channel.tap in VOLTAGE_TAPS else record.units[channel.axis]
        unit_of_column = si_unit if si_unit == "V" else parse_unit(units.get(channel.axis, si_unit))
        columns.append(FileColumn(channel, unit_of_column))
    return FileLayout(",", tuple(columns))


def _check_unit(record: Record, axis: str, unit: str) -> None:
    if axis not in record.axes:
        raise RecordError(
            "units: the record has no axis {axis}; its axes are {names}",
            axis=repr(axis),
            names=" ".join(record.axes),
        )
    try:
        kind = si_unit_of(unit)
    except UnitError as error:
        raise RecordError("units:{axis}: {error}", axis=axis, error=str(error)) from error
    if kind != record.units[axis]:
        raise RecordError(
            "units:{axis}: {unit} cannot be converted to {units}; use another unit",
            axis=axis,
            unit=repr(unit),
            units=record.units[axis],
        )


def _format_header(record: Record, layout: FileLayout) -> bytes:
    headings = ",".join(column.heading for column in layout.columns)
    lines = [*format_comments(record.metadata, DEFAULT_LIMITS.line_bytes), headings]
    return "".join(line + "\n" for line in lines).encode()


def _write_rows(file: BinaryIO, record: Record, layout: FileLayout, rows: slice) -> None:
    signals = [record.time_s[rows], *record.values[rows].T]
    columns = [
        _convert_signal(signal, column, factor)
        for signal, column, factor in zip(signals, layout.columns, layout.per_si, strict=True)
    ]
    write_columns(file, columns)


def _convert_signal(signal: FloatArray, column: FileColumn, factor: float) -> FloatArray:
    if factor == 1.0:
        return signal
    with np.errstate(over="ignore"):
        values = signal * factor
    if not np.isfinite(values).all():
        raise RecordError(
            "record:{column}: too large for [{unit}]; choose a larger unit",
            column=str(column),
            unit=column.unit,
        )
    return values


def write_columns(file: BinaryIO, columns: Sequence[FloatArray]) -> None:
    """Write columns of equal length as rows of numbers with commas as separators.

    Each number has the fewest digits that restore its float64 exactly.
    """
    table = np.stack(columns, axis=1, dtype=np.float64)
    row_count = max(1, _MAX_VALUES_PER_TEXT // len(columns))
    for start in range(0, len(table), row_count):
        file.write(_format_rows(table[start : start + row_count]))


def _format_rows(table: FloatArray) -> bytes:
    if np.isfinite(table).all():
        # The JSON text of an array of arrays is such rows in brackets. orjson formats numbers
        # twice as fast as pyarrow.
        text = orjson.dumps(table, option=orjson.OPT_SERIALIZE_NUMPY)
        return text[2:-2].replace(b"],[", b"\n") + b"\n"
    # JSON has neither NaN nor infinity.
    return "".join(",".join(map(repr, row)) + "\n" for row in table.tolist()).encode()


@contextmanager
def open_export(name: str) -> Iterator[BinaryIO]:
    """Open a file that replaces ``name`` when the context ends without an error.

    The content is compressed if the name ends in ``.gz``.

    Raises
    ------
    RecordError
        If the file cannot be written.
    """
    try:
        with replace_file(name) as file:
            if name.endswith(".gz"):
                with gzip.GzipFile("", "wb", _COMPRESSION_LEVEL, file, mtime=0) as compressed:
                    yield cast(BinaryIO, compressed)
            else:
                yield file
    except FileWriteError as error:
        raise RecordError(str(error)) from error
