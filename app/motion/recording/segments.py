"""The append-only file of a running recording: a sequence of segments.

A segment consists of a header (magic, number, length, CRC-32 of number, length and content) and its
content. Only complete segments count. If the file is truncated, or the last write failed, reading
ends with the last complete segment.
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

from rotemina.app.errors import RecordingError
from rotemina.app.settings import (
    FileOpener,
    open_new_file,
    write_all,
)
from rotemina.sim.files import open_file

if os.name == "nt":  # pragma: no cover - runs on Windows only
    import msvcrt

    # On Windows other programs cannot read locked bytes, so a byte that is never written is locked.
    _LOCK_OFFSET = 1 << 62

    def try_lock(file: BinaryIO) -> bool:
        """Lock a file until it is closed; return False if another program has locked it."""
        position = file.tell()
        file.seek(_LOCK_OFFSET)
        try:
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined,unused-ignore]
        except OSError:
            return False
        finally:
            file.seek(position)
        return True

else:
    import fcntl

    def try_lock(file: BinaryIO) -> bool:
        """Lock a file until it is closed; return False if another program has locked it."""
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            return False
        return True


SEGMENT_MAGIC = b"RTMSEG01"
_PROGRAM_MAGIC = SEGMENT_MAGIC[:6]
_HEADER_FORMAT = struct.Struct("<8sQQI")
_CRC_FIELDS_FORMAT = struct.Struct("<QQ")
_MAX_UNCONFIRMED_BYTES = 64_000_000


class ByteRange(NamedTuple):
    """Offset and length of a segment's content in its file, bytes."""

    offset: int
    length: int


class SegmentFile:
    """File to which segments are appended.

    Segments survive a crash of the process once they are appended, and a power cut once they are
    synced. :meth:`append` and :meth:`sync` may run on two threads, so that a slow disk does not
    delay an append. Segments stay in memory until the disk has confirmed them. They are written
    again if the disk reports a failure.

    The file is locked until it is closed or the process ends. No other program can recover it while
    it is written.

    Raises
    ------
    RecordingError
        If the file exists or cannot be created.
    """

    def __init__(self, path: Path, opener: FileOpener = open_new_file) -> None:
        self.path = path
        #: Length of the complete segments, bytes.
        self.size = 0
        self._next_number = 0
        self._unconfirmed_contents: list[bytes] = []
        # Contents of segments that were lost when a sync failed. The next append rewrites them.
        self._lost_contents: list[bytes] = []
        self._lock = threading.Lock()
        try:
            self._file = opener(path)
        except FileExistsError as error:
            raise RecordingError(
                "{path} already exists, being recorded or left by a crash; record to "
                "another name, or recover it",
                path=path,
            ) from error
        except OSError as error:
            raise RecordingError(
                "{path}: cannot be created ({reason}); choose another folder",
                path=path,
                reason=str(error.strerror or error),
            ) from error
        if not try_lock(self._file):
            self._file.close()
            raise RecordingError(
                "{path}: in use by another program; record to another name", path=path
            )

    def append(self, *contents: bytes) -> None:
        """Write segments at the end of the file.

        Raises
        ------
        OSError
            If the write fails. Then no segment was appended, and the caller may try again.
        """
        with self._lock:
            if sum(map(len, self._unconfirmed_contents)) > _MAX_UNCONFIRMED_BYTES:
                raise OSError(errno.ETIMEDOUT, "the disk does not confirm what was written")
            new_contents = [*self._lost_contents, *contents]
            data = b"".join(
                header_or_content
                for number, content in enumerate(new_contents, self._next_number)
                for header_or_content in (_make_header(number, content), content)
            )
            try:
                self._file.seek(self.size)
                write_all(self._file, data)
            except OSError:
                # If this fails, the bytes left over are not a complete segment, or are overwritten.
                with suppress(OSError):
                    self._file.truncate(self.size)
                raise
            self.size += len(data)
            self._next_number += len(new_contents)
            self._lost_contents = []
            self._unconfirmed_contents += new_contents

    def sync(self) -> None:
        """Wait until the disk has confirmed all earlier appends.

        Raises
        ------
        OSError
            If the disk has failed. The next :meth:`append` writes the unconfirmed segments again.
        """
        with self._lock:
            confirmed_count = len(self._unconfirmed_contents)
        if not confirmed_count:
            return
        try:
            os.fsync(self._file.fileno())
        except OSError:
            with self._lock:
                lost, self._unconfirmed_contents = self._unconfirmed_contents, []
                self._lost_contents = lost + self._lost_contents
                self._next_number -= len(lost)
                self.size -= sum(_HEADER_FORMAT.size + len(content) for content in lost)
            raise
        with self._lock:
            del self._unconfirmed_contents[:confirmed_count]

    def close(self) -> None:
        """Release the file; safe to call twice."""
        self._file.close()


def _make_header(number: int, content: bytes) -> bytes:
    return _HEADER_FORMAT.pack(SEGMENT_MAGIC, number, len(content), _compute_crc(number, content))


def _compute_crc(number: int, content: bytes) -> int:
    return zlib.crc32(content, zlib.crc32(_CRC_FIELDS_FORMAT.pack(number, len(content))))


class SegmentReader:
    """Reader of the complete segments of a file that is no longer written.

    Raises
    ------
    RecordingError
        If the file is not an interrupted recording, has another version, or is being recorded.
    """

    def __init__(self, path: Path) -> None:
        # This refuses a pipe, which would block when opened.
        open_file(path, RecordingError).close()
        try:
            self._file = path.open("r+b")
        except OSError as error:
            raise RecordingError(
                "{path}: cannot be read ({reason})", path=path, reason=str(error.strerror or error)
            ) from error
        try:
            if not try_lock(self._file):
                raise RecordingError(
                    "{path}: still being recorded; end the recording first", path=path
                )
            _check_magic(path, self._file.read(len(SEGMENT_MAGIC)))
        except BaseException:
            self._file.close()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()

    def __iter__(self) -> Iterator[tuple[ByteRange, bytes]]:
        """Yield the range and the content of each segment before the first incomplete one."""
        offset = number = 0
        while True:
            self._file.seek(offset)
            header = self._file.read(_HEADER_FORMAT.size)
            if len(header) < _HEADER_FORMAT.size:
                return
            magic, stored_number, length, crc = _HEADER_FORMAT.unpack(header)
            if (
                magic != SEGMENT_MAGIC
                or stored_number != number
                or length > self._count_remaining_bytes()
            ):
                return
            byte_range = ByteRange(offset + _HEADER_FORMAT.size, length)
            content = self.read(byte_range)
            if _compute_crc(number, content) != crc:
                return
            yield byte_range, content
            offset, number = byte_range.offset + length, number + 1

    def read(self, byte_range: ByteRange) -> bytes:
        """Return the content of a segment; ``byte_range`` is one that the iteration yielded."""
        self._file.seek(byte_range.offset)
        return self._file.read(byte_range.length)

    def _count_remaining_bytes(self) -> int:
        return os.fstat(self._file.fileno()).st_size - self._file.tell()


def _check_magic(path: Path, first_bytes: bytes) -> None:
    if first_bytes == SEGMENT_MAGIC:
        return
    if SEGMENT_MAGIC.startswith(first_bytes):
        raise RecordingError(
            "{path}: interrupted before anything was recorded; delete it", path=path
        )
    if first_bytes.startswith(_PROGRAM_MAGIC):
        raise RecordingError(
            "{path}: version {version}, but this program reads version {known}; recover "
            "it with the program that recorded it",
            path=path,
            version=first_bytes[6:].decode("ascii", "replace"),
            known=SEGMENT_MAGIC[6:].decode(),
        )
    raise RecordingError("{path}: not an interrupted recording of this program", path=path)
