"""The bytes of a record file, in blocks of whole lines, with memory bounded.

Nothing here knows what a line means. What cannot be text, or would fill the memory, is refused
before it is parsed: a directory, a device, binary data, a line without end, a compressed file that
expands without end.
"""

import gzip
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from os import PathLike, fspath
from typing import BinaryIO, cast

import numpy as np

from rotemina.sim.input_files import open_file
from rotemina.sim.messages import marked, message
from rotemina.sim.records.record import RecordError

_LINE_END = ord("\n")
_GZIP_MAGIC = b"\x1f\x8b"
_BYTE_ORDER_MARK = b"\xef\xbb\xbf"


@dataclass(frozen=True, slots=True)
class Limits:
    """Bounds of a record file; what exceeds them is refused, so that no file fills the memory.

    Attributes
    ----------
    line_bytes : longest line.
    expanded_bytes : most that a compressed file may expand to.
    values : most numbers, which need 8 bytes each.
    comment_bytes : most that all ``#`` lines may hold together.
    block_bytes : how much is read and parsed at a time; a choice of speed, not a bound.
    small_block_bytes : up to here a block is parsed in plain Python, which is done before polars
        is even imported; a choice of speed as well.
    """

    line_bytes: int = 1_000_000
    expanded_bytes: int = 4_000_000_000
    values: int = 500_000_000
    comment_bytes: int = 16_000_000
    block_bytes: int = 16_000_000
    small_block_bytes: int = 200_000


LIMITS = Limits()


@dataclass(frozen=True, slots=True)
class Block:
    """Whole lines of a file, each ended by LF.

    Attributes: ``first_line`` is the 1-based number of the first, ``lines`` how many there are.
    """

    first_line: int
    data: bytes
    lines: int = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "lines", count_lines(self.data))

    def line_of(self, offset: int) -> int:
        """Return the number of the line that holds the byte at ``offset``."""
        return self.first_line + self.data.count(b"\n", 0, offset)


def count_lines(data: bytes) -> int:
    """Return how many line ends there are, twice as fast as ``bytes.count``."""
    return int(np.count_nonzero(np.frombuffer(data, dtype=np.uint8) == _LINE_END))


@contextmanager
def open_blocks(path: str | PathLike[str], limits: Limits = LIMITS) -> Iterator[Iterator[Block]]:
    """Open a plain or gzip-compressed file and give its blocks of whole lines.

    Raises
    ------
    RecordError
        If the file cannot be opened or read, is no text or exceeds ``limits``.
    """
    name = fspath(path)
    with open_file(path, RecordError, advice=marked("engine", "name a record file")) as file:
        yield _blocks(name, file, limits)


def _blocks(name: str, file: BinaryIO, limits: Limits) -> Iterator[Block]:
    compressed = file.peek(2)[:2] == _GZIP_MAGIC if hasattr(file, "peek") else False
    stream = cast(BinaryIO, gzip.GzipFile(fileobj=file)) if compressed else file
    line, total = 1, 0
    while data := _whole_lines(name, line, stream, limits):
        total += len(data)
        if compressed and total > limits.expanded_bytes:
            raise RecordError(
                message(
                    "engine",
                    "{name}:{line}: the compressed file expands to more than {expanded_bytes} "
                    "bytes; unpack or split it",
                ).fill(name=name, line=line, expanded_bytes=limits.expanded_bytes)
            )
        if line == 1 and data.startswith(_BYTE_ORDER_MARK):
            data = data[len(_BYTE_ORDER_MARK) :]
        block = Block(line, data if data.endswith(b"\n") else data + b"\n")
        _check_text(name, block, limits)
        yield block
        line += block.lines
    if total == 0:
        raise RecordError(message("engine", "{name}: the file is empty").fill(name=name))


def _whole_lines(name: str, line: int, stream: BinaryIO, limits: Limits) -> bytes:
    data = _read(name, line, stream.read, limits.block_bytes)
    if data and not data.endswith(b"\n"):
        # One byte more than a line may have, LF included, so that _check_text can see the excess.
        data += _read(name, line, stream.readline, limits.line_bytes + 1)
    return data


def _read(name: str, line: int, read: Callable[[int], bytes], size: int) -> bytes:
    try:
        return read(size)
    except EOFError as error:
        raise RecordError(
            message(
                "engine",
                "{name}:{line}: the compressed file ends early, after this line; it was cut off: "
                "copy or record it again",
            ).fill(name=name, line=line)
        ) from error
    except (gzip.BadGzipFile, zlib.error) as error:
        raise RecordError(
            message(
                "engine",
                "{name}:{line}: the compressed data are damaged after this line ({error}); copy "
                "the file again",
            ).fill(name=name, line=line, error=str(error))
        ) from error
    except OSError as error:
        raise RecordError(
            message("engine", "{name}:{line}: reading failed after this line ({error})").fill(
                name=name, line=line, error=str(error)
            )
        ) from error


def _check_text(name: str, block: Block, limits: Limits) -> None:
    binary = block.data.find(b"\0")
    if binary >= 0:
        raise RecordError(
            message(
                "engine",
                "{name}:{line_of}: the file is binary or UTF-16, not UTF-8 text; save it as UTF-8",
            ).fill(name=name, line_of=block.line_of(binary))
        )
    start = 0
    while len(block.data) - start > limits.line_bytes:
        # From one line end to the last one that is within reach: few steps, whatever the lines.
        end = block.data.rfind(b"\n", start, start + limits.line_bytes + 1) + 1
        if end == 0:
            raise RecordError(
                message(
                    "engine",
                    "{name}:{line_of}: the line is longer than {line_bytes} bytes; is this a "
                    "record, with LF or CRLF at the end of each line?",
                ).fill(name=name, line_of=block.line_of(start), line_bytes=limits.line_bytes)
            )
        start = end
