"""Preview of the beginning of a file, for the dialog in which the user names the columns."""

from dataclasses import dataclass
from hashlib import sha256
from os import PathLike, fspath

from rotemina.sim.errors import RecordError
from rotemina.sim.records.fields import (
    BLANKS,
    SEPARATORS,
    is_comment,
    is_empty,
    parse_separator_line,
    split_fields,
    without_padding,
)
from rotemina.sim.records.file_blocks import DEFAULT_LIMITS, FileLimits, open_blocks
from rotemina.sim.records.layout import (
    find_header_separator,
    looks_like_header,
    split_headings,
    splits_into_numbers,
)
from rotemina.sim.records.row_parsing import decode_line

_BLOCK_BYTES = 65_536
_SEPARATOR_NAMES = {";": "semicolon", "\t": "tab", ",": "comma", " ": "blank"}


@dataclass(frozen=True, slots=True)
class FilePreview:
    """The beginning of a file as unchecked text.

    Attributes
    ----------
    separator : the most likely one of ``;``, tab, ``,`` and blank.
    headings : fields of the header row, in the format of any program; empty if there is none.
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
        """Number of fields of the first row, or of the header if there is no row."""
        return len(self.rows[0]) if self.rows else len(self.headings)

    @property
    def fingerprint(self) -> str:
        """A text that is equal for files to which the same column names apply."""
        header = sha256("\n".join(self.headings).encode()).hexdigest()[:16]
        name = _SEPARATOR_NAMES[self.separator]
        return f"{name}:{self.column_count}:{header if self.has_header else 'no header'}"


def read_preview(
    path: str | PathLike[str], *, rows: int = 20, limits: FileLimits = DEFAULT_LIMITS
) -> FilePreview:
    """Read the header and the first ``rows`` rows of a file, and no more.

    Raises
    ------
    RecordError
        If the file cannot be opened, is not text, or contains nothing but comments.
    """
    lines = _read_first_lines(fspath(path), rows + 2, limits)
    stated_separator = parse_separator_line(lines[0]) if lines else None
    if stated_separator in SEPARATORS:
        lines = lines[1:]
    if not lines:
        raise RecordError(
            "{fspath}: no header and no rows; the record is empty", fspath=fspath(path)
        )
    headings: tuple[str, ...] = ()
    if looks_like_header(lines[0]):
        separator = stated_separator or find_header_separator(lines[0])
        headings = tuple(split_headings(lines[0], separator))
        lines = lines[1:]
    else:
        separator = stated_separator or _guess_separator(lines)
    split_rows = tuple(
        tuple(without_padding(split_fields(line, separator), len(headings) or 1))
        for line in lines[:rows]
    )
    return FilePreview(separator, headings, split_rows)


def _read_first_lines(name: str, count: int, limits: FileLimits) -> list[str]:
    small_limits = FileLimits(
        line_bytes=limits.line_bytes,
        expanded_bytes=limits.expanded_bytes,
        block_bytes=_BLOCK_BYTES,
    )
    lines: list[str] = []
    with open_blocks(name, small_limits) as blocks:
        for block in blocks:
            for number, data in enumerate(block.data.split(b"\n"), start=block.first_line):
                text = decode_line(data, name, number).strip(BLANKS)
                if not is_empty(text) and not is_comment(text):
                    lines.append(text)
                if len(lines) == count:
                    return lines
    return lines


def _guess_separator(lines: list[str]) -> str:
    """Return the separator that splits all rows into the same number of values, at least two."""
    for separator in SEPARATORS:
        count = len(without_padding(split_fields(lines[0], separator), 1))
        if count > 1 and all(splits_into_numbers(line, separator, count) for line in lines):
            return separator
    return find_header_separator(lines[0])
