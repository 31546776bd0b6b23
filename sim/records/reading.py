"""Reading of record and trajectory files."""

import re
from collections.abc import Iterator, Mapping
from itertools import chain
from os import PathLike, fspath
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compatibility import serve_former_names
from rotemina.sim.errors import RecordError
from rotemina.sim.records.fields import (
    COMMENT_BEGIN,
    SEPARATORS,
    is_row_with_error,
    parse_separator_line,
)
from rotemina.sim.records.file_blocks import DEFAULT_LIMITS, FileLimits, LineBlock, open_blocks
from rotemina.sim.records.file_end import FileEnd
from rotemina.sim.records.layout import (
    EXAMPLE_HEADER,
    FileColumn,
    FileLayout,
    find_header_separator,
    find_row_separator,
    looks_like_header,
    parse_columns,
    parse_headings,
    split_headings,
    with_units_below,
)
from rotemina.sim.records.metadata import FileComments
from rotemina.sim.records.record import Record
from rotemina.sim.records.row_parsing import RowParser, decode_line
from rotemina.sim.robot import Robot

# A search for a byte is fast, but a search for the beginning of a line is slow. Therefore, the
# pattern begins with "#", and the code checks that a line begins there.
_COMMENT_PATTERN = re.compile(rb"#[^\n]*")
# A line with content. A spreadsheet writes an empty line as separators.
_CONTENT_LINE_PATTERN = re.compile(
    rb"^(?!" + COMMENT_BEGIN + rb')[ \t\r;,"]*+[^ \t\r\n;,"][^\n]*', re.MULTILINE
)
_MAX_BYTES_TO_UNITS = 1_000_000


def read_record(
    path: str | PathLike[str],
    *,
    columns: str | None = None,
    robot: Robot | None = None,
    limits: FileLimits = DEFAULT_LIMITS,
) -> Record:
    """Read a record or trajectory from a plain or compressed file.

    Parameters
    ----------
    path : of the file.
    columns : the columns, such as ``"t [s], x [mm], y.meas [um]"``, of a file without a header row.
        If the file has a header row, both must agree.
    robot : if given, the axes must be its axes, in units of the right quantity. Commands outside
        the range of an axis are accepted: such a record can be shown, but not played.
    limits : bounds of the file.

    Raises
    ------
    RecordError
        If anything in the file is refused. Then nothing is loaded. The message is
        ``file:line:column: what, value, bound, what to do``. Lines are counted from 1. The column
        is a name or a number.
    """
    parts: list[FloatArray] = []
    value_count = 0
    comments = FileComments()
    for parsed in parse_blocks(path, comments, columns=columns, robot=robot, limits=limits):
        parts.append(parsed.rows)
        value_count += parsed.rows.size
        if value_count > limits.values:
            raise RecordError(
                "{fspath}:{first_line}: more than {values} values; split the file",
                fspath=fspath(path),
                first_line=parsed.first_line,
                values=limits.values,
            )
    return assemble_record(parsed.layout, parts, comments.metadata)


class ParsedRows(NamedTuple):
    """Rows (k, columns) of one block in SI, time first, and the number of its first line."""

    layout: FileLayout
    first_line: int
    rows: FloatArray


def parse_blocks(
    path: str | PathLike[str],
    comments: FileComments,
    *,
    columns: str | None,
    robot: Robot | None,
    limits: FileLimits,
) -> Iterator[ParsedRows]:
    """Yield the rows of a file in one or more blocks, and collect its comments.

    Parameters and errors are as in :func:`read_record`.
    """
    name = fspath(path)
    named_columns = None if columns is None else parse_columns(columns, "columns", robot)
    with open_blocks(path, limits) as raw_blocks:
        blocks = collect_comments(name, raw_blocks, comments, limits.comment_bytes)
        layout, first_block = _find_layout(name, blocks, named_columns, robot)
        parser = RowParser(name, layout, small_block_bytes=limits.small_block_bytes)
        file_end = FileEnd(name, layout)
        is_empty = True
        for block in chain([first_block], blocks):
            rows = parser.parse(block)
            file_end.add(block, is_our_format=comments.has_version)
            is_empty = is_empty and len(rows) == 0
            yield ParsedRows(layout, block.first_line, rows)
    if is_empty:
        raise RecordError(
            "{name}:{first_line}: no rows of numbers; the record is empty",
            name=name,
            first_line=first_block.first_line,
        )


def collect_comments(
    name: str, blocks: Iterator[LineBlock], comments: FileComments, max_bytes: int
) -> Iterator[LineBlock]:
    """Yield each block after adding its comments to ``comments``."""
    remaining_bytes = max_bytes
    for block in blocks:
        if b"#" in block.data:
            remaining_bytes -= _collect_block_comments(name, block, comments, remaining_bytes)
        yield block


def _collect_block_comments(
    name: str, block: LineBlock, comments: FileComments, max_bytes: int
) -> int:
    line, counted_to, comment_bytes = block.first_line, 0, 0
    for match in _COMMENT_PATTERN.finditer(block.data):
        start = block.data.rfind(b"\n", 0, match.start()) + 1
        if block.data[start : match.start()].strip() not in (b"", b'"'):
            continue
        line += block.data.count(b"\n", counted_to, start)
        counted_to = start
        comment_bytes += match.end() - start + 1
        if comment_bytes > max_bytes:
            raise RecordError(
                "{name}:{line}: too many bytes of comments; shorten them", name=name, line=line
            )
        text = decode_line(block.data[start : match.end()], name, line)
        if is_row_with_error(text):
            raise RecordError(
                "{name}:{line}: the row begins with a spreadsheet's mark of a missing value or "
                "an error; write its time, or delete the row",
                name=name,
                line=line,
            )
        comments.add(text, f"{name}:{line}")
    return comment_bytes


def _find_layout(
    name: str,
    blocks: Iterator[LineBlock],
    named_columns: tuple[FileColumn, ...] | None,
    robot: Robot | None,
) -> tuple[FileLayout, LineBlock]:
    line, separator = 1, None
    for block in blocks:
        line, start = block.first_line, 0
        while match := _CONTENT_LINE_PATTERN.search(block.data, start):
            line = block.line_of(match.start())
            text = decode_line(match[0], name, line)
            where = f"{name}:{line}"
            start = match.end() + 1
            if separator is None and (separator := parse_separator_line(text)) is not None:
                _check_separator(separator, where)
            elif looks_like_header(text):
                return _parse_header_layout(
                    _Header(text, where, separator or find_header_separator(text)),
                    block.lines_from(start),
                    blocks,
                    named_columns,
                    robot,
                )
            else:
                layout = _find_row_layout(text, where, separator, named_columns)
                return layout, block.lines_from(match.start())
    raise RecordError(
        "{name}:{line}: no header and no rows of numbers; the record is empty", name=name, line=line
    )


def _check_separator(separator: str, where: str) -> None:
    if separator not in SEPARATORS:
        raise RecordError(
            "{where}: the line states the separator {separator}; use a semicolon, comma, tab "
            "or blank",
            where=where,
            separator=repr(separator),
        )


class _Header(NamedTuple):
    text: str
    where: str
    separator: str


def _parse_header_layout(
    header: _Header,
    block: LineBlock,
    blocks: Iterator[LineBlock],
    named_columns: tuple[FileColumn, ...] | None,
    robot: Robot | None,
) -> tuple[FileLayout, LineBlock]:
    text, where, separator = header
    headings = split_headings(text, separator)
    if len(headings) == 1 and separator != find_header_separator(text):
        raise RecordError(
            "{where}: the line above states the separator {separator}, but the header uses "
            "{other}; correct one of them",
            where=where,
            separator=repr(separator),
            other=repr(find_header_separator(text)),
        )
    while (next_line := _CONTENT_LINE_PATTERN.search(block.data)) is None:
        next_block = None if len(block.data) > _MAX_BYTES_TO_UNITS else next(blocks, None)
        if next_block is None:
            break
        block = block.with_next(next_block)
    if next_line is not None and (
        with_units := with_units_below(
            headings, next_line[0].decode("utf-8", "replace").rstrip("\r"), separator
        )
    ):
        headings, block = with_units, block.lines_from(next_line.end() + 1)
    columns = parse_headings(headings, where, robot)
    _check_named_columns(columns, named_columns, where)
    return FileLayout(separator, columns), block


def _check_named_columns(
    columns: tuple[FileColumn, ...], named_columns: tuple[FileColumn, ...] | None, where: str
) -> None:
    if named_columns is not None and named_columns != columns:
        pairs = zip(columns, named_columns, strict=False)
        index = next(
            (
                index
                for index, (heading, named_heading) in enumerate(pairs)
                if heading != named_heading
            ),
            min(len(columns), len(named_columns)),
        )
        heading, named_heading = (
            repr(columns_of_source[index].heading)
            if index < len(columns_of_source)
            else "no column"
            for columns_of_source in (columns, named_columns)
        )
        raise RecordError(
            "{where}:{index}: the header has {found}, but you named {asked}; use the same "
            "name, or omit it",
            where=where,
            index=index + 1,
            found=heading,
            asked=named_heading,
        )


def _find_row_layout(
    text: str, where: str, separator: str | None, named_columns: tuple[FileColumn, ...] | None
) -> FileLayout:
    if named_columns is None:
        raise RecordError(
            "{where}:1: the file has no header row; name its columns, such as '{example}'",
            where=where,
            example=EXAMPLE_HEADER,
        )
    # If no separator fits, the row parser reports what is wrong with this row.
    chosen_separator = (
        separator or find_row_separator(text, len(named_columns)) or find_header_separator(text)
    )
    return FileLayout(chosen_separator, named_columns)


def assemble_record(
    layout: FileLayout, parts: list[FloatArray], metadata: Mapping[str, str]
) -> Record:
    """Join blocks (rows, columns) into a record whose signals are contiguous.

    The list of blocks is emptied on the way, so that the data are not in memory twice.
    """
    rows, columns = sum(map(len, parts)), parts[0].shape[1]
    time_s = np.empty(rows)
    values = np.empty((rows, columns - 1), order="F")
    start = 0
    for index, part in enumerate(parts):
        stop = start + len(part)
        time_s[start:stop] = part[:, 0]
        values[start:stop] = part[:, 1:]
        parts[index] = part[:0]
        start = stop
    return Record(time_s, layout.channels, values, layout.axis_units, metadata)


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        Parsed="ParsedRows",
        assembled="assemble_record",
        collected="collect_comments",
        parsed_blocks="parse_blocks",
    )
