"""Reading of records in pieces, so that long files need bounded memory."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from os import PathLike, fspath

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.records.file_blocks import DEFAULT_LIMITS, FileLimits, open_blocks
from rotemina.sim.records.metadata import FileComments
from rotemina.sim.records.reading import assemble_record, collect_comments, parse_blocks
from rotemina.sim.records.record import Record
from rotemina.sim.robot import Robot

# With pieces of this size, a simulation of six axes takes at most about 400 MB. Larger pieces are
# no faster.
PIECE_ROWS = 32_768
PIECE_LIMITS = replace(DEFAULT_LIMITS, block_bytes=4_000_000)


def read_pieces(
    path: str | PathLike[str],
    *,
    columns: str | None = None,
    robot: Robot | None = None,
    rows: int = PIECE_ROWS,
    limits: FileLimits = PIECE_LIMITS,
) -> Iterator[Record]:
    """Read a record or trajectory in pieces from a plain or compressed file.

    Every piece except the last has ``rows`` rows. All have the metadata of the whole file. Joined,
    the pieces equal the result of :func:`~rotemina.sim.records.read_record`. Parameters and
    errors are the same, but an error is raised only when its piece is read, and ``limits.values``
    is ignored.
    """
    # A comment at the end of the file counts too, so all are collected before the first piece.
    metadata = _read_metadata(path, limits)
    blocks = parse_blocks(path, FileComments(), columns=columns, robot=robot, limits=limits)
    parts: list[FloatArray] = []
    missing_rows = rows
    for layout, _, part in blocks:
        while len(part) >= missing_rows:
            yield assemble_record(layout, [*parts, part[:missing_rows]], metadata)
            part, parts, missing_rows = part[missing_rows:], [], rows
        if len(part):
            parts.append(part)
            missing_rows -= len(part)
    if parts:
        yield assemble_record(layout, parts, metadata)


def _read_metadata(path: str | PathLike[str], limits: FileLimits) -> Mapping[str, str]:
    comments = FileComments()
    with open_blocks(path, limits) as blocks:
        for _ in collect_comments(fspath(path), blocks, comments, limits.comment_bytes):
            pass
    return comments.metadata


def join_records(pieces: Sequence[Record]) -> Record:
    """Join pieces with the same columns into one record.

    Raises
    ------
    RecordError
        If time does not increase from one piece to the next.
    """
    first = pieces[0]
    if len(pieces) == 1:
        return first
    values = np.empty((sum(len(piece.time_s) for piece in pieces), len(first.columns)), order="F")
    np.concatenate([piece.values for piece in pieces], out=values)
    time_s = np.concatenate([piece.time_s for piece in pieces])
    return replace(first, time_s=time_s, values=values)
