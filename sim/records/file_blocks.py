"""Reading of a record file in blocks of whole lines, with bounded memory.

This module does not interpret the lines. Input that cannot be text or would fill the memory is
refused before it is parsed: a folder, a device, binary data, an endless line, or a compressed file
that expands without end.
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

from rotemina.sim.errors import RecordError, describe_exception
from rotemina.sim.files import open_file
from rotemina.sim.messages import marked

if TYPE_CHECKING:
    from _typeshed import WriteableBuffer

_LINE_END = ord("\n")
_GZIP_MAGIC = b"\x1f\x8b"
_BYTE_ORDER_MARK = b"\xef\xbb\xbf"
_UTF16_MARKS = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
_PEEK_BYTES = 4096
_CHUNK_BYTES = 65_536


@dataclass(frozen=True, slots=True)
class FileLimits:
    """Bounds of a record file, so that no file fills the memory.

    Attributes
    ----------
    line_bytes : maximum length of a line.
    expanded_bytes : maximum size of a decompressed file.
    values : maximum number of values, which need 8 bytes each.
    comment_bytes : maximum total length of all ``#`` lines.
    block_bytes : size of the blocks that are read and parsed. It affects only the speed.
    small_block_bytes : blocks up to this size are parsed in plain Python, which is faster than
        importing pyarrow. It affects only the speed.
    """

    line_bytes: int = 1_000_000
    expanded_bytes: int = 4_000_000_000
    values: int = 500_000_000
    comment_bytes: int = 16_000_000
    block_bytes: int = 16_000_000
    small_block_bytes: int = 200_000


DEFAULT_LIMITS = FileLimits()


@dataclass(frozen=True, slots=True)
class LineBlock:
    """A block of whole lines of a file, each terminated by LF.

    Attributes
    ----------
    first_line : number of the first line, counted from 1.
    data : the bytes.
    unterminated : whether the last line has no line end in the file. Then the LF was added.
    lines : number of lines.
    """

    first_line: int
    data: bytes
    unterminated: bool = False
    lines: int = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "lines", count_lines(self.data))

    def line_of(self, offset: int) -> int:
        """Return the number of the line that contains the byte at ``offset``."""
        return self.first_line + self.data.count(b"\n", 0, offset)

    @property
    def last_line(self) -> int:
        """The number of the last line."""
        return self.first_line + self.lines - 1

    def lines_from(self, offset: int) -> "LineBlock":
        """Return the rest of the block from the line that begins at ``offset``."""
        return LineBlock(self.line_of(offset), self.data[offset:], self.unterminated)

    def with_next(self, block: "LineBlock") -> "LineBlock":
        """Return this block and the next one as a single block."""
        return LineBlock(self.first_line, self.data + block.data, block.unterminated)


def count_lines(data: bytes) -> int:
    """Return the number of line ends, twice as fast as ``bytes.count``."""
    return int(np.count_nonzero(np.frombuffer(data, dtype=np.uint8) == _LINE_END))


@contextmanager
def open_blocks(
    path: str | PathLike[str], limits: FileLimits = DEFAULT_LIMITS
) -> Iterator[Iterator[LineBlock]]:
    """Open a plain or gzip-compressed file and return an iterator over its blocks of whole lines.

    Raises
    ------
    RecordError
        If the file cannot be opened or read, is not text, or exceeds ``limits``.
    """
    name = fspath(path)
    with open_file(path, RecordError, advice=marked("engine", "name a record file")) as file:
        yield _read_blocks(name, file, limits)


def _read_blocks(name: str, file: BinaryIO, limits: FileLimits) -> Iterator[LineBlock]:
    stream = cast(io.BufferedReader, file)
    compressed = _peek(name, stream).startswith(_GZIP_MAGIC)
    if compressed:
        stream = cast(io.BufferedReader, gzip.GzipFile(fileobj=file))
    stream = _as_utf8_lines(name, stream)
    line, total = 1, 0
    while data := _read_whole_lines(name, line, stream, limits):
        total += len(data)
        if compressed and total > limits.expanded_bytes:
            raise RecordError(
                "{name}:{line}: the compressed file expands to more than {expanded_bytes} "
                "bytes; unpack or split it",
                name=name,
                line=line,
                expanded_bytes=limits.expanded_bytes,
            )
        if line == 1 and data.startswith(_BYTE_ORDER_MARK):
            data = data[len(_BYTE_ORDER_MARK) :]
        is_terminated = data.endswith(b"\n")
        block = LineBlock(
            line, data if is_terminated else data + b"\n", unterminated=not is_terminated
        )
        _check_text(name, block, stream, limits)
        yield block
        line += block.lines
    if total == 0:
        raise RecordError("{name}: the file is empty", name=name)


def _peek(name: str, stream: io.BufferedReader) -> bytes:
    return _read_or_refuse(name, 1, stream.peek, _PEEK_BYTES)


def _as_utf8_lines(name: str, stream: io.BufferedReader) -> io.BufferedReader:
    """Return a stream in UTF-8 with LF, converted if it is UTF-16 or has CR as line ends."""
    if _peek(name, stream).startswith(_UTF16_MARKS):
        decoder = codecs.getincrementaldecoder("utf-16")()
        stream = _convert_stream(stream, lambda data: decoder.decode(data, final=not data).encode())
    first_bytes = _peek(name, stream)
    # The last of these bytes may be the CR of a CRLF.
    if b"\r" in first_bytes[:-1] and b"\n" not in first_bytes:
        stream = _convert_stream(stream, lambda data: data.replace(b"\r", b"\n"))
    return stream


def _convert_stream(stream: BinaryIO, convert: Callable[[bytes], bytes]) -> io.BufferedReader:
    return io.BufferedReader(_ConvertedBytes(stream, convert), _CHUNK_BYTES)


class _ConvertedBytes(io.RawIOBase):
    def __init__(self, stream: BinaryIO, convert: Callable[[bytes], bytes]) -> None:
        self._stream = stream
        self._convert = convert
        self._converted = b""

    def readable(self) -> bool:
        return True

    def readinto(self, buffer: "WriteableBuffer") -> int:
        target = memoryview(buffer)
        while not self._converted:
            data = self._stream.read(_CHUNK_BYTES)
            self._converted = self._convert(data)
            if not data:
                break
        count = min(len(target), len(self._converted))
        target[:count] = self._converted[:count]
        self._converted = self._converted[count:]
        return count


def _read_whole_lines(name: str, line: int, stream: BinaryIO, limits: FileLimits) -> bytes:
    data = _read_or_refuse(name, line, stream.read, limits.block_bytes)
    if data and not data.endswith(b"\n"):
        # One byte more than the maximum, including LF, so that _check_text detects the excess.
        data += _read_or_refuse(name, line, stream.readline, limits.line_bytes + 1)
    return data


def _read_or_refuse(name: str, line: int, read: Callable[[int], bytes], size: int) -> bytes:
    try:
        return read(size)
    except EOFError as error:
        raise RecordError(
            "{name}:{line}: the compressed file ends early, after this line; it was cut off: "
            "copy or record it again",
            name=name,
            line=line,
        ) from error
    except (gzip.BadGzipFile, zlib.error) as error:
        raise RecordError(
            "{name}:{line}: the compressed data are damaged after this line ({error}); copy "
            "the file again",
            name=name,
            line=line,
            error=describe_exception(error),
        ) from error
    except UnicodeError as error:
        raise RecordError(
            "{name}:{line}: the UTF-16 text is damaged or cut off after this line; copy the "
            "file again, or save it as UTF-8",
            name=name,
            line=line,
        ) from error
    except OSError as error:
        raise RecordError(
            "{name}:{line}: reading failed after this line ({error})",
            name=name,
            line=line,
            error=describe_exception(error),
        ) from error


def _check_text(name: str, block: LineBlock, stream: BinaryIO, limits: FileLimits) -> None:
    zero_offset = block.data.find(b"\0")
    if zero_offset >= 0:
        line = block.line_of(zero_offset)
        if _is_zero_to_the_end(name, line, block.data[zero_offset:], stream, limits):
            raise _make_zero_tail_error(name, line)
        raise RecordError(
            "{name}:{line_of}: the file is binary or UTF-16, not UTF-8 text; save it as UTF-8",
            name=name,
            line_of=line,
        )
    start = 0
    while len(block.data) - start > limits.line_bytes:
        # Jumping to the last line end within the maximum length needs few steps.
        end = block.data.rfind(b"\n", start, start + limits.line_bytes + 1) + 1
        if end == 0:
            raise RecordError(
                "{name}:{line_of}: the line is longer than {line_bytes} bytes; is this a "
                "record, with LF or CRLF at the end of each line?",
                name=name,
                line_of=block.line_of(start),
                line_bytes=limits.line_bytes,
            )
        start = end


def _is_zero_to_the_end(
    name: str, line: int, data: bytes, stream: BinaryIO, limits: FileLimits
) -> bool:
    """Return whether the rest of a file is zero bytes, reading no more than the limits permit."""
    data, total = data.rstrip(b"\n"), 0
    while not data.strip(b"\0"):
        data = _read_or_refuse(name, line, stream.read, limits.block_bytes)
        total += len(data)
        if not data or total > limits.expanded_bytes:
            return True
    return False


def _make_zero_tail_error(name: str, line: int) -> RecordError:
    if line == 1:
        return RecordError(
            "{name}: the file contains only zero bytes, probably because of a power cut; use "
            "another copy",
            name=name,
        )
    return RecordError(
        "{name}:{line}: the file ends in zero bytes, probably because of a power cut; delete "
        "everything after line {last}, the last complete one",
        name=name,
        line=line,
        last=line - 1,
    )
