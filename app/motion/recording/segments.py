"""The append-only file of a running recording: segments, each either complete or ignored.

A segment is a header (magic, number, length, CRC-32 of number, length and content) and its
content. A file that was cut off anywhere, or whose last writing failed, ends with its last whole
segment.
"""

import errno
import os
import struct
import threading
import zlib
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO, NamedTuple, Self

from rotemina.app.files import Opener, new_file, write_all
from rotemina.app.motion.recording.errors import RecordingError
from rotemina.sim.input_files import open_file
from rotemina.sim.messages import message

if os.name == "nt":  # pragma: no cover - the other system's half
    import msvcrt

    _BEHIND = 1 << 62  # a byte that nobody writes: Windows keeps others from locked ones

    def locked(file: BinaryIO) -> bool:
        """Lock a file until it is closed; return False if someone else has."""
        at = file.tell()
        file.seek(_BEHIND)
        try:
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined,unused-ignore]
        except OSError:
            return False
        finally:
            file.seek(at)
        return True

else:
    import fcntl

    def locked(file: BinaryIO) -> bool:
        """Lock a file until it is closed; return False if someone else has."""
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            return False
        return True


MAGIC = b"RTMSEG01"
_PROGRAM = MAGIC[:6]
_HEADER = struct.Struct("<8sQQI")
_COUNTED = struct.Struct("<QQ")
_MOST_UNCONFIRMED = 64_000_000  # bytes


class ByteRange(NamedTuple):
    """Where in a file the content of a segment lies, bytes."""

    offset: int
    length: int


class SegmentFile:
    """Appends segments. They survive the process once appended, and the machine once synced.

    :meth:`append` and :meth:`sync` may run on two threads: a disk that confirms slowly delays no
    append. Unconfirmed data stay in memory, to be written again if the disk reports a failure.

    The file is locked, so that nobody recovers it while it is written; the lock ends with the
    process.

    Raises
    ------
    RecordingError
        If the file exists or cannot be made.
    """

    def __init__(self, path: Path, opener: Opener = new_file) -> None:
        self.path = path
        #: Bytes of whole segments.
        self.size = 0
        self._number = 0
        self._unconfirmed: list[bytes] = []  # contents
        self._again: list[bytes] = []  # contents that were lost when a sync failed
        self._lock = threading.Lock()
        try:
            self._file = opener(path)
        except FileExistsError as error:
            raise RecordingError(
                message(
                    "engine",
                    "{path} already exists, being recorded or left by a crash; record to "
                    "another name, or recover it",
                ).fill(path=path)
            ) from error
        except OSError as error:
            raise RecordingError(
                message(
                    "engine", "{path}: cannot be created ({reason}); choose another folder"
                ).fill(path=path, reason=str(error.strerror or error))
            ) from error
        if not locked(self._file):
            self._file.close()
            raise RecordingError(
                message("engine", "{path}: in use by another program; record to another name").fill(
                    path=path
                )
            )

    def append(self, *contents: bytes) -> None:
        """Write segments.

        Raises
        ------
        OSError
            If it cannot; nothing of them counts then, and they may be tried again.
        """
        with self._lock:
            if sum(map(len, self._unconfirmed)) > _MOST_UNCONFIRMED:
                raise OSError(errno.ETIMEDOUT, "the disk does not confirm what was written")
            due = [*self._again, *contents]
            written = b"".join(
                piece
                for number, content in enumerate(due, self._number)
                for piece in (_header(number, content), content)
            )
            try:
                self._file.seek(self.size)
                write_all(self._file, written)
            except OSError:
                with suppress(OSError):  # what is left is no whole segment, or will be written over
                    self._file.truncate(self.size)
                raise
            self.size += len(written)
            self._number += len(due)
            self._again = []
            self._unconfirmed += due

    def sync(self) -> None:
        """Wait until the disk has all earlier appends.

        Raises
        ------
        OSError
            If it has failed; what it did not confirm is written again by the next `append`.
        """
        with self._lock:
            count = len(self._unconfirmed)
        if not count:
            return
        try:
            os.fsync(self._file.fileno())
        except OSError:
            with self._lock:
                lost, self._unconfirmed = self._unconfirmed, []
                self._again = lost + self._again
                self._number -= len(lost)
                self.size -= sum(_HEADER.size + len(content) for content in lost)
            raise
        with self._lock:
            del self._unconfirmed[:count]

    def close(self) -> None:
        """Release the file; safe to call twice."""
        self._file.close()


def _header(number: int, content: bytes) -> bytes:
    return _HEADER.pack(MAGIC, number, len(content), _crc(number, content))


def _crc(number: int, content: bytes) -> int:
    return zlib.crc32(content, zlib.crc32(_COUNTED.pack(number, len(content))))


class WholeSegments:
    """The complete segments of a file that is no longer written.

    Raises
    ------
    RecordingError
        If it is no such file, is of another version, or is being recorded.
    """

    def __init__(self, path: Path) -> None:
        open_file(path, RecordingError).close()  # a pipe would be waited for
        try:
            self._file = path.open("r+b")
        except OSError as error:
            raise RecordingError(
                message("engine", "{path}: cannot be read ({reason})").fill(
                    path=path, reason=str(error.strerror or error)
                )
            ) from error
        try:
            if not locked(self._file):
                raise RecordingError(
                    message("engine", "{path}: still being recorded; end the recording first").fill(
                        path=path
                    )
                )
            _check_kind(path, self._file.read(len(MAGIC)))
        except BaseException:
            self._file.close()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()

    def __iter__(self) -> Iterator[tuple[ByteRange, bytes]]:
        """Yield range and content of each segment, up to the first incomplete one."""
        at = number = 0
        while True:
            self._file.seek(at)
            head = self._file.read(_HEADER.size)
            if len(head) < _HEADER.size:
                return
            magic, found, length, crc = _HEADER.unpack(head)
            if magic != MAGIC or found != number or length > self._left():
                return
            byte_range = ByteRange(at + _HEADER.size, length)
            content = self.read(byte_range)
            if _crc(number, content) != crc:
                return
            yield byte_range, content
            at, number = byte_range.offset + length, number + 1

    def read(self, byte_range: ByteRange) -> bytes:
        """Return the content at a range that was given before."""
        self._file.seek(byte_range.offset)
        return self._file.read(byte_range.length)

    def _left(self) -> int:
        return os.fstat(self._file.fileno()).st_size - self._file.tell()


def _check_kind(path: Path, head: bytes) -> None:
    if head == MAGIC:
        return
    if MAGIC.startswith(head):
        raise RecordingError(
            message("engine", "{path}: interrupted before anything was recorded; delete it").fill(
                path=path
            )
        )
    if head.startswith(_PROGRAM):
        raise RecordingError(
            message(
                "engine",
                "{path}: version {version}, but this program reads version {known}; recover "
                "it with the program that recorded it",
            ).fill(path=path, version=head[6:].decode("ascii", "replace"), known=MAGIC[6:].decode())
        )
    raise RecordingError(
        message("engine", "{path}: not an interrupted recording of this program").fill(path=path)
    )
