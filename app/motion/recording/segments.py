"""The append-only file that a recording is while it runs: segments, each found whole or not at all.

A segment is a header (magic, number, length, CRC-32 of number, length and content) and its
content. A file that was cut off anywhere, or whose last writing failed, ends with its last whole
segment.
"""

import os
import struct
import zlib
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO, NamedTuple, Self

from rotemina.app.motion.recording.errors import RecordingError
from rotemina.app.motion.recording.locking import locked

MAGIC = b"RTMSEG01"
_PROGRAM = MAGIC[:6]
_HEADER = struct.Struct("<8sQQI")
_COUNTED = struct.Struct("<QQ")

Opener = Callable[[Path], BinaryIO]


def new_file(path: Path) -> BinaryIO:
    """Open a file that is not there yet, without a buffer of our own."""
    return path.open("xb", buffering=0)


class Place(NamedTuple):
    """Where in a file the content of a segment lies, bytes."""

    offset: int
    length: int


class SegmentFile:
    """Appends segments; each is on the disk when :meth:`append` returns.

    The file is locked, so that nobody recovers it while it is written; a process that ends, however
    it does, lets go of it.

    Raises
    ------
    RecordingError
        If the file exists or cannot be made.
    """

    def __init__(self, path: Path, opener: Opener = new_file) -> None:
        self.path = path
        self._end = 0
        self._number = 0
        try:
            self._file = opener(path)
        except FileExistsError as error:
            raise RecordingError(
                f"{path}: it is there already, being recorded or left by a crash; "
                "record to another name, or recover it"
            ) from error
        except OSError as error:
            raise RecordingError(
                f"{path}: cannot be made ({error.strerror or error}); choose another folder"
            ) from error
        if not locked(self._file):
            self._file.close()
            raise RecordingError(f"{path}: another program has it; record to another name")

    @property
    def size(self) -> int:
        """Bytes of whole segments."""
        return self._end

    def append(self, *contents: bytes) -> None:
        """Write segments, and wait until the disk has them.

        Raises
        ------
        OSError
            If it cannot; nothing of them counts then, and they may be tried again.
        """
        written = b"".join(
            piece
            for number, content in enumerate(contents, self._number)
            for piece in (_header(number, content), content)
        )
        try:
            self._file.seek(self._end)
            self._write(written)
            os.fsync(self._file.fileno())
        except OSError:
            with suppress(OSError):  # what is left is no whole segment, or will be written over
                self._file.truncate(self._end)
            raise
        self._end += len(written)
        self._number += len(contents)

    def close(self) -> None:
        """Let go of the file; safe to call twice."""
        self._file.close()

    def _write(self, data: bytes) -> None:
        rest = memoryview(data)
        while rest:  # a disk that fills up takes a part, and refuses the next
            rest = rest[self._file.write(rest) :]


def _header(number: int, content: bytes) -> bytes:
    return _HEADER.pack(MAGIC, number, len(content), _crc(number, content))


def _crc(number: int, content: bytes) -> int:
    return zlib.crc32(content, zlib.crc32(_COUNTED.pack(number, len(content))))


class WholeSegments:
    """The whole segments of a file that nobody writes any more.

    Raises
    ------
    RecordingError
        If it is no such file, is of another version, or is being recorded.
    """

    def __init__(self, path: Path) -> None:
        try:
            self._file = path.open("r+b")
        except OSError as error:
            raise RecordingError(f"{path}: cannot be read ({error.strerror or error})") from error
        try:
            if not locked(self._file):
                raise RecordingError(f"{path}: it is still being recorded; end that first")
            _check_kind(path, self._file.read(len(MAGIC)))
        except BaseException:
            self._file.close()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()

    def __iter__(self) -> Iterator[tuple[Place, bytes]]:
        """Give place and content of one after the other, up to the first that is not whole."""
        at = number = 0
        while True:
            self._file.seek(at)
            head = self._file.read(_HEADER.size)
            if len(head) < _HEADER.size:
                return
            magic, found, length, crc = _HEADER.unpack(head)
            if magic != MAGIC or found != number or length > self._left():
                return
            place = Place(at + _HEADER.size, length)
            content = self.read(place)
            if _crc(number, content) != crc:
                return
            yield place, content
            at, number = place.offset + length, number + 1

    def read(self, place: Place) -> bytes:
        """Return the content at a place that was given before."""
        self._file.seek(place.offset)
        return self._file.read(place.length)

    def _left(self) -> int:
        return os.fstat(self._file.fileno()).st_size - self._file.tell()


def _check_kind(path: Path, head: bytes) -> None:
    if head == MAGIC:
        return
    if MAGIC.startswith(head):
        raise RecordingError(f"{path}: it was cut off before anything was recorded; delete it")
    if head.startswith(_PROGRAM):
        raise RecordingError(
            f"{path}: of version {head[6:].decode('ascii', 'replace')}; this program reads "
            f"{MAGIC[6:].decode()}: recover it with the program that recorded it"
        )
    raise RecordingError(f"{path}: no recording of this program that was cut off")
