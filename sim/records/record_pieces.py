"""Records in pieces: files that are read with bounded memory, however long they are."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from os import PathLike, fspath

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.records.file_blocks import LIMITS, Limits, open_blocks
from rotemina.sim.records.metadata import Comments
from rotemina.sim.records.reading import assembled, collected, parsed_blocks
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import Robot

# With these a simulation of six axes takes about 400 MB at most; larger ones are no faster.
PIECE_ROWS = 32_768
PIECE_LIMITS = replace(LIMITS, block_bytes=4_000_000)


def read_pieces(
    path: str | PathLike[str],
    *,
    columns: str | None = None,
    robot: Robot | None = None,
    rows: int = PIECE_ROWS,
    limits: Limits = PIECE_LIMITS,
) -> Iterator[Record]:
    """Import a record or trajectory piece by piece, plain or compressed.

    Every piece has ``rows`` rows, but for the last, and the metadata of the whole file. Joined,
    they are what :func:`~rotemina.sim.records.reading.read_record` returns; parameters and errors
    are its own, an error coming when its piece does. ``limits.values`` does not bind.
    """
    # A comment counts wherever it stands, so all are collected before the first row is given.
    metadata = _metadata(path, limits)
    blocks = parsed_blocks(path, Comments(), columns=columns, robot=robot, limits=limits)
    held: list[FloatArray] = []
    missing = rows
    for layout, _, part in blocks:
        while len(part) >= missing:
            yield assembled(layout, [*held, part[:missing]], metadata)
            part, held, missing = part[missing:], [], rows
        if len(part):
            held.append(part)
            missing -= len(part)
    if held:
        yield assembled(layout, held, metadata)


def _metadata(path: str | PathLike[str], limits: Limits) -> Mapping[str, str]:
    comments = Comments()
    with open_blocks(path, limits) as blocks:
        for _ in collected(fspath(path), blocks, comments, limits.comment_bytes):
            pass
    return comments.metadata


def join_records(pieces: Sequence[Record]) -> Record:
    """Return pieces of the same columns, one behind the other, as one record.

    Raises
    ------
    RecordError
        If time does not increase from one to the next.
    """
    first = pieces[0]
    if len(pieces) == 1:
        return first
    values = np.empty((sum(len(piece.time_s) for piece in pieces), len(first.columns)), order="F")
    np.concatenate([piece.values for piece in pieces], out=values)
    time_s = np.concatenate([piece.time_s for piece in pieces])
    return replace(first, time_s=time_s, values=values)
