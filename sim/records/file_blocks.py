"""The bytes of a record file, in blocks of whole lines, with memory bounded.

Nothing here knows what a line means. What cannot be text, or would fill the memory, is refused
before it is parsed: a directory, a device, binary data, a line without end, a compressed file that
expands without end.
"""

import codecs
import gzip
import io
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from os import PathLike, fspath
from typing import TYPE_CHECKING, BinaryIO, cast

import numpy as np

from rotemina.sim.errors import reason_of
from rotemina.sim.input_files import open_file
from rotemina.sim.messages import marked, message
from rotemina.sim.records.record import RecordError

if TYPE_CHECKING:
    from _typeshed import WriteableBuffer

_LINE_END = ord("\n")
_GZIP_MAGIC = b"\x1f\x8b"
_BYTE_ORDER_MARK = b"\xef\xbb\xbf"
_UTF16_MARKS = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
_PROBE_BYTES = 4096
_CHUNK_BYTES = 65_536


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

    Attributes
    ----------
    first_line : 1-based number of the first line.
    unterminated : whether the last line has no line end in the file, where the LF was added.
    lines : how many there are.
    """

    first_line: int
    data: bytes
    unterminated: bool = False
    lines: int = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "lines", count_lines(self.data))

    def line_of(self, offset: int) -> int:
        """Return the number of the line that holds the byte at ``offset``."""
        return self.first_line + self.data.count(b"\n", 0, offset)

    @property
    def last_line(self) -> int:
        """The number of the last line."""
        return self.first_line + self.lines - 1

    def following(self, offset: int) -> "Block":
        """Return the lines from the one that begins at ``offset``."""
        return Block(self.line_of(offset), self.data[offset:], self.unterminated)

    def with_next(self, block: "Block") -> "Block":
        """Return these lines and those of the next block as one."""
        return Block(self.first_line, self.data + block.data, block.unterminated)


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
    stream = cast(io.BufferedReader, file)
    compressed = _begin(name, stream).startswith(_GZIP_MAGIC)
    if compressed:
        stream = cast(io.BufferedReader, gzip.GzipFile(fileobj=file))
    stream = _as_utf8_lines(name, stream)
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
        whole = data.endswith(b"\n")
        block = Block(line, data if whole else data + b"\n", unterminated=not whole)
        _check_text(name, block, stream, limits)
        yield block
        line += block.lines
    if total == 0:
        raise RecordError(message("engine", "{name}: the file is empty").fill(name=name))


def _begin(name: str, stream: io.BufferedReader) -> bytes:
    """Return the next bytes of a stream without reading past them."""
    return _read(name, 1, stream.peek, _PROBE_BYTES)


def _as_utf8_lines(name: str, stream: io.BufferedReader) -> io.BufferedReader:
    """Return a stream as UTF-8 with LF, where it begins as UTF-16 or has CR as its line ends."""
    if _begin(name, stream).startswith(_UTF16_MARKS):
        decoder = codecs.getincrementaldecoder("utf-16")()
        stream = _converted(stream, lambda data: decoder.decode(data, final=not data).encode())
    begin = _begin(name, stream)
    # A CR at the end of what can be seen may be one of a CRLF.
    if b"\r" in begin[:-1] and b"\n" not in begin:
        stream = _converted(stream, lambda data: data.replace(b"\r", b"\n"))
    return stream


def _converted(stream: BinaryIO, convert: Callable[[bytes], bytes]) -> io.BufferedReader:
    return io.BufferedReader(_ConvertedBytes(stream, convert), _CHUNK_BYTES)


class _ConvertedBytes(io.RawIOBase):
    """The bytes of a stream, converted chunk by chunk; an empty chunk ends the conversion."""

    def __init__(self, stream: BinaryIO, convert: Callable[[bytes], bytes]) -> None:
        self._stream = stream
        self._convert = convert
        self._left = b""

    def readable(self) -> bool:
        return True

    def readinto(self, buffer: "WriteableBuffer") -> int:
        target = memoryview(buffer)
        while not self._left:
            data = self._stream.read(_CHUNK_BYTES)
            self._left = self._convert(data)
            if not data:
                break
        count = min(len(target), len(self._left))
        target[:count] = self._left[:count]
        self._left = self._left[count:]
        return count


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
            ).fill(name=name, line=line, error=reason_of(error))
        ) from error
    except UnicodeError as error:
        raise RecordError(
            message(
                "engine",
                "{name}:{line}: the UTF-16 text is damaged or cut off after this line; copy the "
                "file again, or save it as UTF-8",
            ).fill(name=name, line=line)
        ) from error
    except OSError as error:
        raise RecordError(
            message("engine", "{name}:{line}: reading failed after this line ({error})").fill(
                name=name, line=line, error=reason_of(error)
            )
        ) from error


def _check_text(name: str, block: Block, stream: BinaryIO, limits: Limits) -> None:
    binary = block.data.find(b"\0")
    if binary >= 0:
        line = block.line_of(binary)
        if _is_zero_to_the_end(name, line, block.data[binary:], stream, limits):
            raise _zero_tail(name, line)
        raise RecordError(
            message(
                "engine",
                "{name}:{line_of}: the file is binary or UTF-16, not UTF-8 text; save it as UTF-8",
            ).fill(name=name, line_of=line)
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


def _is_zero_to_the_end(
    name: str, line: int, data: bytes, stream: BinaryIO, limits: Limits
) -> bool:
    """Return whether the rest of a file is zero bytes, which is looked for within its bounds."""
    data, total = data.rstrip(b"\n"), 0
    while not data.strip(b"\0"):
        data = _read(name, line, stream.read, limits.block_bytes)
        total += len(data)
        if not data or total > limits.expanded_bytes:
            return True
    return False


def _zero_tail(name: str, line: int) -> RecordError:
    if line == 1:
        return RecordError(
            message(
                "engine",
                "{name}: the file holds no whole line, only zero bytes, as a power cut leaves "
                "them; use another copy",
            ).fill(name=name)
        )
    return RecordError(
        message(
            "engine",
            "{name}:{line}: the file ends in zero bytes, as a power cut leaves them; cut it after "
            "line {last}, the last whole one",
        ).fill(name=name, line=line, last=line - 1)
    )
