"""Fast parsing of rows with pyarrow.

:func:`parse` returns None if its result could differ from that of the strict parser.
"""

import re
from collections.abc import Iterator

import numpy as np
import pyarrow as pa  # type: ignore[import-untyped,unused-ignore] # it comes without types
import pyarrow.csv  # type: ignore[import-untyped,unused-ignore]

from rotemina.sim.arrays import FloatArray
from rotemina.sim.records.fields import COMMENT_BEGIN
from rotemina.sim.records.file_blocks import count_lines

_COMMENT_LINES = re.compile(rb"^" + COMMENT_BEGIN + rb"[^\n]*\n", re.MULTILINE)


def without_comments(data: bytes) -> tuple[bytes, int]:
    """Return lines without the comments among them, and the number of comments."""
    # A search for two bytes takes a hundred times as long as a search for one byte.
    may_have_comments = any(sign in data for sign in (b"#", b"%", b"/"))
    return _COMMENT_LINES.subn(b"", data) if may_have_comments else (data, 0)


def find_decimal_sign(rows: bytes, separator: str) -> str | None:
    """Return the decimal sign of rows, "" if there is none, or None if it is ambiguous.

    If the separator is a comma, all commas are separators. A comma in a quoted number would be a
    decimal sign, but quoted numbers are left to the strict parser.
    """
    if separator == ",":
        return "." if b"." in rows else ""
    signs = [sign for sign in ",." if sign.encode() in rows]
    return None if len(signs) > 1 else "".join(signs)


def normalise(data: bytes, separator: str) -> bytes | None:
    """Return rows without blanks, quotes, CR and decimal commas, or None if a stray CR remains.

    Each step is skipped if a search, which is very fast, finds nothing to do.
    """
    if b"\r" in data:
        data = data.replace(b"\r\n", b"\n")
        if b"\r" in data:
            return None
    if separator != "," and b"," in data:
        data = data.replace(b",", b".")
    if separator != "\t" and b"\t" in data:
        data = data.replace(b"\t", b" ")
    if b" " in data:
        data = _without_blanks(data, separator.encode())
    if b'"' in data:
        data = _without_quotes(data, separator.encode())
    return data


def _without_quotes(data: bytes, separator: bytes) -> bytes:
    """Return rows without quotes if each pair encloses one whole field, otherwise unchanged.

    Quotes within a field and separators within quotes are left to the strict parser.
    """
    characters = np.frombuffer(data, dtype=np.uint8)
    quotes = np.flatnonzero(characters == ord('"'))
    if len(quotes) % 2:
        return data
    opening, closing = quotes[::2], quotes[1::2]
    is_end = (characters == ord(separator)) | (characters == ord("\n"))
    ends = np.flatnonzero(is_end)
    # For a quote at the very beginning, index -1 refers to the LF at the end of the data, which
    # counts as the end of the field before.
    are_pairs = is_end[opening - 1].all() and is_end[closing + 1].all()
    are_non_empty = (closing - opening > 1).all()
    in_one_field = (np.searchsorted(ends, opening) == np.searchsorted(ends, closing)).all()
    return data.replace(b'"', b"") if are_pairs and are_non_empty and in_one_field else data


def _without_blanks(data: bytes, separator: bytes) -> bytes:
    while b"  " in data:
        data = data.replace(b"  ", b" ")
    for delimiter in {separator, b"\n"} - {b" "}:
        data = data.replace(b" " + delimiter, delimiter).replace(delimiter + b" ", delimiter)
    return data.removeprefix(b" ")


def _without_fillers(data: bytes, separator: bytes) -> bytes:
    """Return rows without empty lines, and without the separators at their ends.

    A row that consists of separators is left to the strict parser.
    """
    if b"\n" + separator not in b"\n" + data[:1] and b"\n" + separator not in data:
        while separator + b"\n" in data:
            data = data.replace(separator + b"\n", b"\n")
    while b"\n\n" in data:
        data = data.replace(b"\n\n", b"\n")
    return data.removeprefix(b"\n")


def parse(data: bytes, lines: int, separator: str, columns: int) -> FloatArray | None:
    """Return the numbers (rows, columns) of rows, or None if the strict parser must decide."""
    rows = normalise(data, separator)
    if rows is None:
        return None
    numbers = _read_numbers(rows, lines, separator, columns)
    if numbers is None:
        # This search is slow, so it comes last.
        compact_rows = _without_fillers(rows, separator.encode())
        if len(compact_rows) < len(rows):
            numbers = _read_numbers(compact_rows, count_lines(compact_rows), separator, columns)
    return numbers


def _read_numbers(rows: bytes, lines: int, separator: str, columns: int) -> FloatArray | None:
    """Return (lines, columns) finite numbers, or None if there is anything else.

    pyarrow raises an error for a row of another length, and for a field that is not a number. It
    would skip a byte order mark.
    """
    if not rows:
        return np.empty((0, columns))
    if not rows.isascii():
        return None
    numbers = np.empty((lines, columns), order="F")
    row_count = 0
    try:
        for batch in _read_batches(rows, separator, columns):
            if row_count + len(batch) > lines:
                return None
            batch_rows = slice(row_count, row_count + len(batch))
            for index, column in enumerate(batch.columns):
                # pyarrow's own conversion to numpy imports pandas if it is installed.
                numbers[batch_rows, index] = np.from_dlpack(column)
            row_count += len(batch)
    except pa.ArrowInvalid:
        return None
    return numbers if row_count == lines and np.isfinite(numbers).all() else None


def _read_batches(rows: bytes, separator: str, columns: int) -> Iterator[pa.RecordBatch]:
    names = [str(index) for index in range(columns)]
    with pa.csv.open_csv(
        pa.BufferReader(rows),
        pa.csv.ReadOptions(column_names=names),
        pa.csv.ParseOptions(delimiter=separator, quote_char=False, ignore_empty_lines=False),
        pa.csv.ConvertOptions(
            column_types=dict.fromkeys(names, pa.float64()), null_values=[], check_utf8=False
        ),
    ) as batches:
        yield from batches
