"""Recording of a camera's pictures as a video: a bounded queue and a writer thread."""

import logging
import threading
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType

from rotemina.app.cameras.video_file import VideoFile
from rotemina.app.files import Opener, new_file
from rotemina.drivers.cameras.frame import Frame
from rotemina.sim.errors import InputError, reason_of
from rotemina.sim.messages import message

_LOG = logging.getLogger(__name__)

CAPACITY_BYTES = 200_000_000  # of pictures that wait for the disk: 2.5 s of 1300 × 1030 at 30 Hz
_LONGEST_S = 10.0  # that a close waits for a disk that hangs


class VideoError(InputError):
    """A film that cannot be made, or ended before it should."""


@dataclass(frozen=True, slots=True)
class VideoStatus:
    """The status of a video.

    Attributes
    ----------
    pictures : int
        On the disk.
    dropped : int
        Not recorded, because the disk was too slow or the camera's size or kind had changed.
    bytes_written : int
    lasts_s : float
        From the first to the last picture.
    failure : str
        Why it ended by itself, and what to do; empty while it has not.
    """

    pictures: int = 0
    dropped: int = 0
    bytes_written: int = 0
    lasts_s: float = 0.0
    failure: str = ""


class Video:
    """Records every picture that it is given until :meth:`close`.

    Each page of the file has its picture's number and ``host_time_s``, on the clock of the session
    and of its recordings. What is on the disk can be read at any moment.

    Parameters
    ----------
    path : Path
        Of a file that does not exist.
    facts : mapping
        What holds for the whole film, as JSON can hold it.
    pixel_m : float or None
        Size of a pixel in the specimen, m.
    tell : callable
        Gets what the operator must know, on the thread that writes.
    capacity_bytes : int
        Of what may wait; a picture that has no room is dropped and counted.
    opener : callable
        How the file is made.

    Raises
    ------
    VideoError
        If there is a file already, or none can be made.
    """

    def __init__(
        self,
        path: Path,
        facts: Mapping[str, object] = MappingProxyType({}),
        *,
        pixel_m: float | None = None,
        tell: Callable[[str], None] = lambda _: None,
        capacity_bytes: int = CAPACITY_BYTES,
        opener: Opener = new_file,
    ) -> None:
        self.path = path
        self._tell = tell
        self._capacity = capacity_bytes
        self._waiting: deque[Frame] = deque()
        self._bytes = 0
        self._changed = threading.Condition()  # guards the two above and the status
        #: The status; replaced as a whole.
        self.status = VideoStatus()
        self._ending = False
        self._told_dropped = False
        self._first: Frame | None = None  # of the writer's thread alone
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            self._file = VideoFile(path, facts, pixel_m, opener)
        except OSError as error:
            if path.exists():
                raise VideoError(
                    message("engine", "{path} already exists; record to another name").fill(
                        path=path
                    )
                ) from error
            raise VideoError(
                message(
                    "engine",
                    "{path}: cannot be written ({reason}); make room, or choose another folder",
                ).fill(path=path, reason=reason_of(error))
            ) from error
        self._thread = threading.Thread(target=self._run, name="video", daemon=True)

    def start(self) -> None:
        """Begin to write."""
        self._thread.start()

    def take(self, frame: Frame) -> None:
        """Queue a picture for writing; returns at once, on any thread."""
        size = frame.pixels.nbytes
        with self._changed:
            if self._ending or self.status.failure:
                return
            if self._bytes + size > self._capacity:
                self._count(dropped=1)
                return
            self._waiting.append(frame)
            self._bytes += size
            self._changed.notify()

    def close(self, timeout_s: float = _LONGEST_S) -> VideoStatus:
        """Write what waits, end, and return how it went; safe to call twice.

        Raises
        ------
        VideoError
            If the disk hangs; what is in the file can be read.
        """
        with self._changed:
            self._ending = True
            self._changed.notify()
        if self._thread.is_alive():
            self._thread.join(timeout_s)
        if self._thread.is_alive():
            raise VideoError(
                message(
                    "engine",
                    "{path}: the last pictures could not be written within {timeout_s} s; "
                    "{pictures} pictures are kept",
                ).fill(path=self.path, timeout_s=timeout_s, pictures=self.status.pictures)
            )
        self._file.close()
        return self.status

    # --- on the writer's thread -------------------------------------------------------------------

    def _run(self) -> None:
        while (frame := self._next()) is not None:
            if self.status.failure:
                continue
            try:
                self._write(frame)
            except Exception as error:  # the thread must end in words, whatever happens
                self._fail(error)
            self._tell_dropped()

    def _next(self) -> Frame | None:
        """Wait for a picture; None: that was the last."""
        with self._changed:
            self._changed.wait_for(lambda: self._waiting or self._ending)
            if not self._waiting:
                return None
            frame = self._waiting.popleft()
            self._bytes -= frame.pixels.nbytes
            return frame

    def _write(self, frame: Frame) -> None:
        if self._first is None:
            self._first = frame
        if not _alike(frame, self._first):
            with self._changed:
                self._count(dropped=1)
            return
        self._file.append(frame)
        with self._changed:
            self._count(pictures=1, lasts_s=frame.host_time_s - self._first.host_time_s)

    def _count(self, *, pictures: int = 0, dropped: int = 0, lasts_s: float | None = None) -> None:
        was = self.status
        self.status = replace(
            was,
            pictures=was.pictures + pictures,
            dropped=was.dropped + dropped,
            bytes_written=self._file.size,
            lasts_s=was.lasts_s if lasts_s is None else lasts_s,
        )

    def _fail(self, error: Exception) -> None:
        why = reason_of(error)
        kept = self.status.pictures
        failure = message(
            "engine",
            "{path}: the video has ended ({why}); {kept} pictures are kept. Free disk space, "
            "or choose another folder, and start another one",
        ).fill(path=self.path, why=why, kept=kept)
        _LOG.warning(failure)
        with self._changed:
            self.status = replace(self.status, failure=failure)
            self._waiting.clear()
            self._bytes = 0
        self._tell(failure)

    def _tell_dropped(self) -> None:
        """Say once that pictures are missing, while there is something to be done about it."""
        if self.status.dropped and not self._told_dropped:
            self._told_dropped = True
            self._tell(
                message(
                    "engine",
                    "{name}: pictures are missing in the video: the disk is too slow, or the "
                    "camera's settings were changed. Use a smaller region, fewer pictures "
                    "per second, or another disk; start another video after a change of "
                    "settings",
                ).fill(name=self.path.name)
            )


def _alike(one: Frame, other: Frame) -> bool:
    """Return whether two pictures can be pages of one film."""
    return one.pixels.shape == other.pixels.shape and one.pixels.dtype == other.pixels.dtype
