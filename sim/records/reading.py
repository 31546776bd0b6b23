"""Import of record and trajectory files."""

import re
from collections.abc import Iterator, Mapping
from itertools import chain
from os import PathLike, fspath
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message
from rotemina.sim.records.file_blocks import LIMITS, Block, Limits, open_blocks
from rotemina.sim.records.layout import (
    EXAMPLE,
    Column,
    Layout,
    header_separator,
    looks_like_header,
    parse_columns,
    row_separator,
)
from rotemina.sim.records.metadata import Comments
from rotemina.sim.records.record import Record, RecordError
from rotemina.sim.records.row_parsing import RowParser, decode_line
from rotemina.sim.robot.model import Robot

_COMMENT_LINE = re.compile(rb"^[ \t]*#[^\n]*", re.MULTILINE)
_FIRST_LINE = re.compile(rb"^[ \t\r]*[^# \t\r\n][^\n]*", re.MULTILINE)


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
        empty = True
        for block in chain([first], blocks):
            rows = parser.parse(block)
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
    for match in _COMMENT_LINE.finditer(block.data):
        line += block.data.count(b"\n", counted, match.start())
        counted = match.start()
        collected += len(match[0]) + 1
        if collected > most_bytes:
            raise RecordError(
                message("engine", "{name}:{line}: too many bytes of comments; shorten them").fill(
                    name=name, line=line
                )
            )
        comments.add(decode_line(match[0], name, line), f"{name}:{line}")
    return collected


def _find_layout(
    name: str, blocks: Iterator[Block], named: tuple[Column, ...] | None, robot: Robot | None
) -> tuple[Layout, Block]:
    """Return the layout and what is left of the block in which it was found."""
    line = 1
    for block in blocks:
        match = _FIRST_LINE.search(block.data)
        if match is None:
            line = block.first_line
            continue
        line = block.line_of(match.start())
        text = decode_line(match[0], name, line)
        if looks_like_header(text):
            layout = _layout_of_header(text, f"{name}:{line}", named, robot)
            return layout, Block(line + 1, block.data[match.end() + 1 :])
        layout = _layout_of_row(text, f"{name}:{line}", named)
        return layout, Block(line, block.data[match.start() :])
    raise RecordError(
        message(
            "engine", "{name}:{line}: no header and no rows of numbers; the record is empty"
        ).fill(name=name, line=line)
    )


def _layout_of_header(
    text: str, where: str, named: tuple[Column, ...] | None, robot: Robot | None
) -> Layout:
    columns = parse_columns(text, where, robot)
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
    return Layout(header_separator(text), columns)


def _layout_of_row(text: str, where: str, named: tuple[Column, ...] | None) -> Layout:
    if named is None:
        raise RecordError(
            message(
                "engine",
                "{where}:1: the file has no header row; name its columns, such as '{example}'",
            ).fill(where=where, example=EXAMPLE)
        )
    # Where no separator fits, the row parser finds what is wrong with this row.
    return Layout(row_separator(text, len(named)) or header_separator(text), named)


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
