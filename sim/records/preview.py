"""A look at the beginning of a file: what a dialog shows while the user names the columns."""

from dataclasses import dataclass
from hashlib import sha256
from os import PathLike, fspath

from rotemina.sim.messages import message
from rotemina.sim.records.fields import (
    BLANKS,
    SEPARATORS,
    is_comment,
    is_empty,
    named_separator,
    split_fields,
    without_padding,
)
from rotemina.sim.records.file_blocks import LIMITS, Limits, open_blocks
from rotemina.sim.records.layout import (
    header_separator,
    looks_like_header,
    split_headings,
    splits_into_numbers,
)
from rotemina.sim.records.record import RecordError
from rotemina.sim.records.row_parsing import decode_line

_BLOCK_BYTES = 65_536
_SEPARATOR_NAMES = {";": "semicolon", "\t": "tab", ",": "comma", " ": "blank"}


@dataclass(frozen=True, slots=True)
class Preview:
    """The beginning of a file as text, unchecked.

    Attributes
    ----------
    separator : the best guess, one of ``;``, tab, ``,`` and blank.
    headings : the header row's fields, of this program or any other; empty if there is none.
    rows : the first rows, each split into fields.
    """

    separator: str
    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]

    @property
    def has_header(self) -> bool:
        """Whether the first line names columns."""
        return bool(self.headings)

    @property
    def column_count(self) -> int:
        """How many fields the first row has, or the header where there is no row."""
        return len(self.rows[0]) if self.rows else len(self.headings)

    @property
    def fingerprint(self) -> str:
        """The file's shape as text: equal for files that the same column names fit."""
        header = sha256("\n".join(self.headings).encode()).hexdigest()[:16]
        name = _SEPARATOR_NAMES[self.separator]
        return f"{name}:{self.column_count}:{header if self.has_header else 'no header'}"


def preview(path: str | PathLike[str], *, rows: int = 20, limits: Limits = LIMITS) -> Preview:
    """Return the header and the first ``rows`` rows of a file, reading no more than they need.

    Raises
    ------
    RecordError
        If the file cannot be opened, is no text or holds no line beside comments.
    """
    lines = _first_lines(fspath(path), rows + 2, limits)
    named = named_separator(lines[0]) if lines else None
    if named in SEPARATORS:
        lines = lines[1:]
    if not lines:
        raise RecordError(
            message("engine", "{fspath}: no header and no rows; the record is empty").fill(
                fspath=fspath(path)
            )
        )
    headings: tuple[str, ...] = ()
    if looks_like_header(lines[0]):
        separator = named or header_separator(lines[0])
        headings = tuple(split_headings(lines[0], separator))
        lines = lines[1:]
    else:
        separator = named or _guess_separator(lines)
    fields = tuple(
        tuple(without_padding(split_fields(line, separator), len(headings) or 1))
        for line in lines[:rows]
    )
    return Preview(separator, headings, fields)


def _first_lines(name: str, count: int, limits: Limits) -> list[str]:
    """Return up to ``count`` lines that are neither empty nor comments."""
    small = Limits(
        line_bytes=limits.line_bytes,
        expanded_bytes=limits.expanded_bytes,
        block_bytes=_BLOCK_BYTES,
    )
    lines: list[str] = []
    with open_blocks(name, small) as blocks:
        for block in blocks:
            for number, data in enumerate(block.data.split(b"\n"), start=block.first_line):
                text = decode_line(data, name, number).strip(BLANKS)
                if not is_empty(text) and not is_comment(text):
                    lines.append(text)
                if len(lines) == count:
                    return lines
    return lines


def _guess_separator(lines: list[str]) -> str:
    """Return the separator that splits all rows into equally many numbers, at least two."""
    for sign in SEPARATORS:
        count = len(without_padding(split_fields(lines[0], sign), 1))
        if count > 1 and all(splits_into_numbers(line, sign, count) for line in lines):
            return sign
    return header_separator(lines[0])
