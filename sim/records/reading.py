"""Import of record and trajectory files."""

import re
from collections.abc import Iterator, Mapping
from itertools import chain
from os import PathLike, fspath
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message
from rotemina.sim.records.fields import (
    COMMENT_BEGIN,
    SEPARATORS,
    is_row_with_error,
    named_separator,
)
from rotemina.sim.records.file_blocks import LIMITS, Block, Limits, open_blocks
from rotemina.sim.records.file_end import FileEnd
from rotemina.sim.records.layout import (
    EXAMPLE,
    Column,
    Layout,
    columns_of,
    header_separator,
    looks_like_header,
    parse_columns,
    row_separator,
    split_headings,
    with_units_below,
)
from rotemina.sim.records.metadata import Comments
from rotemina.sim.records.record import Record, RecordError
from rotemina.sim.records.row_parsing import RowParser, decode_line
from rotemina.sim.robot.model import Robot

# A byte to begin with is found at once, the beginning of a line is not.
_COMMENT = re.compile(rb"#[^\n]*")
# A line that holds something: a spreadsheet writes separators alone for an empty one.
_FIRST_LINE = re.compile(
    rb"^(?!" + COMMENT_BEGIN + rb')[ \t\r;,"]*+[^ \t\r\n;,"][^\n]*', re.MULTILINE
)
_MOST_BYTES_TO_UNITS = 1_000_000


def read_record(
    path: str | PathLike[str],
    *,
    columns: str | None = None,
    robot: Robot | None = None,
    limits: Limits = LIMITS,
) -> Record:
    """Import a record or trajectory, plain or compressed.

    Parameters
    ----------
    path : of the file.
    columns : what the columns are, such as ``"t [s], x [mm], y.meas [um]"``, for a file without a
        header row; where there is one, both must agree.
    robot : if given, the axes must be its axes, and lengths or angles as it says. A command beyond
        an axis' range is read all the same: it may be looked at, not played.
    limits : bounds of the file.

    Raises
    ------
    RecordError
        If anything in the file is refused; nothing is loaded then. The message is
        ``file:line:column: what, value, bound, what to do``, with the line counted from 1 and the
        column by name or number.
    """
    parts: list[FloatArray] = []
    count = 0
    comments = Comments()
    for parsed in parsed_blocks(path, comments, columns=columns, robot=robot, limits=limits):
        parts.append(parsed.rows)
        count += parsed.rows.size
        if count > limits.values:
            raise RecordError(
                message(
                    "engine", "{fspath}:{first_line}: more than {values} values; split the file"
                ).fill(fspath=fspath(path), first_line=parsed.first_line, values=limits.values)
            )
    return assembled(parsed.layout, parts, comments.metadata)


class Parsed(NamedTuple):
    """Rows (k, columns) of one block in SI, time first, and the line at which it begins."""

    layout: Layout
    first_line: int
    rows: FloatArray


def parsed_blocks(
    path: str | PathLike[str],
    comments: Comments,
    *,
    columns: str | None,
    robot: Robot | None,
    limits: Limits,
) -> Iterator[Parsed]:
    """Give the rows of a file block by block, at least one; collect its comments on the way.

    Parameters and errors as of :func:`read_record`.
    """
    name = fspath(path)
    named = None if columns is None else parse_columns(columns, "columns", robot)
    with open_blocks(path, limits) as raw_blocks:
        blocks = collected(name, raw_blocks, comments, limits.comment_bytes)
        layout, first = _find_layout(name, blocks, named, robot)
        parser = RowParser(name, layout, small_block_bytes=limits.small_block_bytes)
        file_end = FileEnd(name, layout)
        empty = True
        for block in chain([first], blocks):
            rows = parser.parse(block)
            file_end.add(block, is_our_format=comments.name_our_format)
            empty = empty and len(rows) == 0
            yield Parsed(layout, block.first_line, rows)
    if empty:
        raise RecordError(
            message("engine", "{name}:{first_line}: no rows of numbers; the record is empty").fill(
                name=name, first_line=first.first_line
            )
        )


def collected(
    name: str, blocks: Iterator[Block], comments: Comments, most_bytes: int
) -> Iterator[Block]:
    """Give on each block after collecting its comments."""
    bytes_left = most_bytes
    for block in blocks:
        if b"#" in block.data:
            bytes_left -= _collect(name, block, comments, bytes_left)
        yield block


def _collect(name: str, block: Block, comments: Comments, most_bytes: int) -> int:
    """Collect the comments of one block and return how many bytes they have."""
    line, counted, collected = block.first_line, 0, 0
    for match in _COMMENT.finditer(block.data):
        begin = block.data.rfind(b"\n", 0, match.start()) + 1
        if block.data[begin : match.start()].strip() not in (b"", b'"'):
            continue
        line += block.data.count(b"\n", counted, begin)
        counted = begin
        collected += match.end() - begin + 1
        if collected > most_bytes:
            raise RecordError(
                message("engine", "{name}:{line}: too many bytes of comments; shorten them").fill(
                    name=name, line=line
                )
            )
        text = decode_line(block.data[begin : match.end()], name, line)
        if is_row_with_error(text):
            raise RecordError(
                message(
                    "engine",
                    "{name}:{line}: the row begins with a spreadsheet's mark of a missing value or "
                    "an error; write its time, or delete the row",
                ).fill(name=name, line=line)
            )
        comments.add(text, f"{name}:{line}")
    return collected


def _find_layout(
    name: str, blocks: Iterator[Block], named: tuple[Column, ...] | None, robot: Robot | None
) -> tuple[Layout, Block]:
    """Return the layout and what is left of the block in which it was found."""
    line, separator = 1, None
    for block in blocks:
        line, start = block.first_line, 0
        while match := _FIRST_LINE.search(block.data, start):
            line = block.line_of(match.start())
            text = decode_line(match[0], name, line)
            where = f"{name}:{line}"
            start = match.end() + 1
            if separator is None and (separator := named_separator(text)) is not None:
                _check_separator(separator, where)
            elif looks_like_header(text):
                return _layout_of_header(
                    _Header(text, where, separator or header_separator(text)),
                    block.following(start),
                    blocks,
                    named,
                    robot,
                )
            else:
                layout = _layout_of_row(text, where, separator, named)
                return layout, block.following(match.start())
    raise RecordError(
        message(
            "engine", "{name}:{line}: no header and no rows of numbers; the record is empty"
        ).fill(name=name, line=line)
    )


def _check_separator(separator: str, where: str) -> None:
    if separator not in SEPARATORS:
        raise RecordError(
            message(
                "engine",
                "{where}: the line names {separator} as separator of columns; use a semicolon, "
                "comma, tab or blank",
            ).fill(where=where, separator=repr(separator))
        )


class _Header(NamedTuple):
    """A header row, where it stands, and what separates its headings."""

    text: str
    where: str
    separator: str


def _layout_of_header(
    header: _Header,
    block: Block,
    blocks: Iterator[Block],
    named: tuple[Column, ...] | None,
    robot: Robot | None,
) -> tuple[Layout, Block]:
    """Return the layout, and the lines below the header and its row of units, if it has one."""
    text, where, separator = header
    headings = split_headings(text, separator)
    if len(headings) == 1 and separator != header_separator(text):
        raise RecordError(
            message(
                "engine",
                "{where}: the line above names {separator} as separator of columns, but the header "
                "has {other}; correct one of them",
            ).fill(where=where, separator=repr(separator), other=repr(header_separator(text)))
        )
    while (below := _FIRST_LINE.search(block.data)) is None:
        following = None if len(block.data) > _MOST_BYTES_TO_UNITS else next(blocks, None)
        if following is None:
            break
        block = block.with_next(following)
    if below is not None and (
        with_units := with_units_below(
            headings, below[0].decode("utf-8", "replace").rstrip("\r"), separator
        )
    ):
        headings, block = with_units, block.following(below.end() + 1)
    columns = columns_of(headings, where, robot)
    _check_named(columns, named, where)
    return Layout(separator, columns), block


def _check_named(columns: tuple[Column, ...], named: tuple[Column, ...] | None, where: str) -> None:
    if named is not None and named != columns:
        pairs = zip(columns, named, strict=False)
        index = next(
            (index for index, (found, asked) in enumerate(pairs) if found != asked),
            min(len(columns), len(named)),
        )
        found, asked = (
            repr(each[index].heading) if index < len(each) else "no column"
            for each in (columns, named)
        )
        raise RecordError(
            message(
                "engine",
                "{where}:{index}: the header names {found} where you named {asked}; use the "
                "same name, or omit it",
            ).fill(where=where, index=index + 1, found=found, asked=asked)
        )


def _layout_of_row(
    text: str, where: str, separator: str | None, named: tuple[Column, ...] | None
) -> Layout:
    if named is None:
        raise RecordError(
            message(
                "engine",
                "{where}:1: the file has no header row; name its columns, such as '{example}'",
            ).fill(where=where, example=EXAMPLE)
        )
    # Where no separator fits, the row parser finds what is wrong with this row.
    found = separator or row_separator(text, len(named)) or header_separator(text)
    return Layout(found, named)


def assembled(layout: Layout, parts: list[FloatArray], metadata: Mapping[str, str]) -> Record:
    """Join (rows, columns) blocks into a record; each signal is contiguous.

    The blocks are given up one by one, so that the whole is not held twice.
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
