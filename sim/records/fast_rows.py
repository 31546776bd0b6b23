"""Parsing and writing rows with polars, at the speed of a data library.

:func:`parse` gives up, by returning None, wherever it could differ from the strict parser.
"""

import re

import numpy as np
import polars as pl

from rotemina.sim.arrays import FloatArray
from rotemina.sim.records.fields import COMMENT_BEGIN
from rotemina.sim.records.file_blocks import count_lines

_COMMENT_LINES = re.compile(rb"^" + COMMENT_BEGIN + rb"[^\n]*\n", re.MULTILINE)


def without_comments(data: bytes) -> tuple[bytes, int]:
    """Return whole lines without those that are comments, and how many those were."""
    # A search for two bytes takes a hundred times as long as one for a byte.
    marked = any(sign in data for sign in (b"#", b"%", b"/"))
    return _COMMENT_LINES.subn(b"", data) if marked else (data, 0)


def decimal_sign(rows: bytes, separator: str) -> str | None:
    """Return the decimal sign of rows, "" if there is none and None if it is in doubt.

    Commas are separators where those are commas, but for quoted numbers, which are not read here.
    """
    if separator == ",":
        return "." if b"." in rows else ""
    signs = [sign for sign in ",." if sign.encode() in rows]
    return None if len(signs) > 1 else "".join(signs)


def normalise(data: bytes, separator: str) -> bytes | None:
    """Return rows without blanks, quotes, CR and decimal commas; None where a stray CR is left.

    Each step is left out where a search, which costs next to nothing, finds nothing to do.
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
    """Return rows without quotes, if each pair of them encloses one whole field; else as they are.

    Quotes within a field, and separators within quotes, are for the strict parser.
    """
    signs = np.frombuffer(data, dtype=np.uint8)
    quotes = np.flatnonzero(signs == ord('"'))
    if len(quotes) % 2:
        return data
    opening, closing = quotes[::2], quotes[1::2]
    is_end = (signs == ord(separator)) | (signs == ord("\n"))
    ends = np.flatnonzero(is_end)
    # The data end with LF, which also stands in for the end of a field before the first.
    are_pairs = is_end[opening - 1].all() and is_end[closing + 1].all()
    are_full = (closing - opening > 1).all()
    in_one_field = (np.searchsorted(ends, opening) == np.searchsorted(ends, closing)).all()
    return data.replace(b'"', b"") if are_pairs and are_full and in_one_field else data


def _without_blanks(data: bytes, separator: bytes) -> bytes:
    while b"  " in data:
        data = data.replace(b"  ", b" ")
    for sign in {separator, b"\n"} - {b" "}:
        data = data.replace(b" " + sign, sign).replace(sign + b" ", sign)
    return data.removeprefix(b" ")


def _without_fillers(data: bytes, separator: bytes) -> bytes:
    """Return rows without empty lines, and without the separators at their ends.

    A row of separators alone is for the strict parser.
    """
    if b"\n" + separator not in b"\n" + data[:1] and b"\n" + separator not in data:
        while separator + b"\n" in data:
            data = data.replace(separator + b"\n", b"\n")
    while b"\n\n" in data:
        data = data.replace(b"\n\n", b"\n")
    return data.removeprefix(b"\n")


def parse(data: bytes, lines: int, separator: str, columns: int) -> FloatArray | None:
    """Return the (rows, columns) numbers of rows, or None where the strict parser decides."""
    rows = normalise(data, separator)
    if rows is None:
        return None
    numbers = _read_numbers(rows, lines, separator, columns)
    if numbers is None:
        # Searched for last, because it is the one search that takes its time.
        shorter = _without_fillers(rows, separator.encode())
        if len(shorter) < len(rows):
            numbers = _read_numbers(shorter, count_lines(shorter), separator, columns)
    return numbers


def _read_numbers(rows: bytes, lines: int, separator: str, columns: int) -> FloatArray | None:
    """Return (lines, columns) finite numbers, or None if there is anything else.

    polars reads a missing field as null, which becomes NaN here; it raises at anything else that
    is no number.
    """
    if not rows:
        return np.empty((0, columns))
    schema = {str(index): pl.Float64 for index in range(columns)}
    try:
        table = pl.read_csv(
            rows, has_header=False, schema=schema, separator=separator, quote_char=None
        )
    except pl.exceptions.PolarsError:
        return None
    numbers = table.to_numpy(order="fortran", writable=True)
    whole = numbers.shape == (lines, columns)
    return numbers if whole and np.isfinite(numbers).all() else None
