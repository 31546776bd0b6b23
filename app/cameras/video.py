"""Records the pictures of a camera as a video, through a bounded queue and a writer thread."""

import logging
import threading
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType

from rotemina.app.cameras.video_file import VideoFile
from rotemina.app.errors import VideoError
from rotemina.app.settings import FileOpener, open_new_file
from rotemina.drivers.cameras import CameraFrame
from rotemina.sim.errors import (
    describe_exception,
)
from rotemina.sim.messages import (
    message,
)

_LOG = logging.getLogger(__name__)

# Size of the pictures that may wait for the disk; holds 2.5 s of 1300 × 1030 pixels at 30 Hz.
QUEUE_CAPACITY_BYTES = 200_000_000
# Longest time for which ``close`` waits for a disk that hangs.
_CLOSE_TIMEOUT_S = 10.0


@dataclass(frozen=True, slots=True)
class VideoStatus:
    """The status of a video.

    Attributes
    ----------
    pictures : int
        Number of pictures on the disk.
    dropped : int
        Number of pictures not recorded because the disk was too slow, or because their size or
        pixel type had changed.
    bytes_written : int
    lasts_s : float
        Time from the first to the last picture.
    failure : str
        Why the recording ended by itself, and what to do; empty if it did not.
    """

    pictures: int = 0
    dropped: int = 0
    bytes_written: int = 0
    duration_s: float = 0.0
    failure: str = ""


class VideoRecorder:
    """Records every picture that it receives, until :meth:`close`.

    Each page of the file contains its picture's number and ``host_time_s``, on the clock of the
    session and of its recordings. The file on the disk can be read at any moment.

    Parameters
    ----------
    path : Path
        The file, which must not exist.
    metadata : mapping
        Metadata of the whole video; must be convertible to JSON.
    pixel_m : float or None
        Size of a pixel in the specimen, m.
    notify : callable
        Called with messages for the operator, on the writer thread.
    capacity_bytes : int
        Capacity of the queue; a picture that does not fit is dropped and counted.
    opener : callable
        Creates the file.

    Raises
    ------
    VideoError
        If the file exists already, or cannot be created.
    """

    def __init__(
        self,
        path: Path,
        metadata: Mapping[str, object] = MappingProxyType({}),
        *,
        pixel_m: float | None = None,
        notify: Callable[[str], None] = lambda _: None,
        capacity_bytes: int = QUEUE_CAPACITY_BYTES,
        opener: FileOpener = open_new_file,
    ) -> None:
        self.path = path
        self._notify = notify
        self._capacity_bytes = capacity_bytes
        self._queue: deque[CameraFrame] = deque()
        self._queued_bytes = 0
        # Guards the queue, its size and the status.
        self._queue_changed = threading.Condition()
        #: The status; replaced as a whole.
        self.status = VideoStatus()
        self._is_closing = False
        self._has_reported_dropped = False
        # Used only by the writer thread.
        self._first_frame: CameraFrame | None = None
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            self._file = VideoFile(path, metadata, pixel_m, opener)
        except OSError as error:
            if path.exists():
                raise VideoError(
                    "{path} already exists; record to another name", path=path
                ) from error
            raise VideoError(
                "{path}: cannot be written ({reason}); make room, or choose another folder",
                path=path,
                reason=describe_exception(error),
            ) from error
        self._thread = threading.Thread(target=self._run, name="video", daemon=True)

    def start(self) -> None:
        """Start the writer thread."""
        self._thread.start()

    def queue_frame(self, frame: CameraFrame) -> None:
        """Queue a picture for writing; returns at once, and may be called from any thread."""
        size = frame.pixels.nbytes
        with self._queue_changed:
            if self._is_closing or self.status.failure:
                return
            if self._queued_bytes + size > self._capacity_bytes:
                self._update_status(dropped=1)
                return
            self._queue.append(frame)
            self._queued_bytes += size
            self._queue_changed.notify()

    def close(self, timeout_s: float = _CLOSE_TIMEOUT_S) -> VideoStatus:
        """Write the queued pictures, close the file, and return the status; safe to call twice.

        Raises
        ------
        VideoError
            If the disk hangs. The file is readable up to its last complete picture.
        """
        with self._queue_changed:
            self._is_closing = True
            self._queue_changed.notify()
        if self._thread.is_alive():
            self._thread.join(timeout_s)
        if self._thread.is_alive():
            raise VideoError(
                "{path}: the last pictures could not be written within {timeout_s} s; "
                "{pictures} pictures are kept",
                path=self.path,
                timeout_s=timeout_s,
                pictures=self.status.pictures,
            )
        self._file.close()
        return self.status

    def _run(self) -> None:
        while (frame := self._wait_for_frame()) is not None:
            if self.status.failure:
                continue
            try:
                self._write(frame)
            except Exception as error:
                # Whatever happens, the operator must see why the video has ended.
                self._fail(error)
            self._report_dropped()

    def _wait_for_frame(self) -> CameraFrame | None:
        """Wait for a picture; None means that there are no more."""
        with self._queue_changed:
            self._queue_changed.wait_for(lambda: self._queue or self._is_closing)
            if not self._queue:
                return None
            frame = self._queue.popleft()
            self._queued_bytes -= frame.pixels.nbytes
            return frame

    def _write(self, frame: CameraFrame) -> None:
        if self._first_frame is None:
            self._first_frame = frame
        if not _has_same_format(frame, self._first_frame):
            with self._queue_changed:
                self._update_status(dropped=1)
            return
        self._file.append(frame)
        with self._queue_changed:
            self._update_status(
                pictures=1, lasts_s=frame.host_time_s - self._first_frame.host_time_s
            )

    def _update_status(
        self, *, pictures: int = 0, dropped: int = 0, lasts_s: float | None = None
    ) -> None:
        previous = self.status
        self.status = replace(
            previous,
            pictures=previous.pictures + pictures,
            dropped=previous.dropped + dropped,
            bytes_written=self._file.size,
            duration_s=previous.duration_s if lasts_s is None else lasts_s,
        )

    def _fail(self, error: Exception) -> None:
        reason = describe_exception(error)
        pictures = self.status.pictures
        failure = message(
            "engine",
            "{path}: the video has ended ({why}); {kept} pictures are kept. Free disk space, "
            "or choose another folder, and start another one",
        ).fill(path=self.path, why=reason, kept=pictures)
        _LOG.warning(failure)
        with self._queue_changed:
            self.status = replace(self.status, failure=failure)
            self._queue.clear()
            self._queued_bytes = 0
        self._notify(failure)

    def _report_dropped(self) -> None:
        if self.status.dropped and not self._has_reported_dropped:
            self._has_reported_dropped = True
            self._notify(
                message(
                    "engine",
                    "{name}: pictures are missing in the video: the disk is too slow, or the "
                    "camera's settings were changed. Use a smaller region, fewer pictures "
                    "per second, or another disk; start another video after a change of "
                    "settings",
                ).fill(name=self.path.name)
            )


def _has_same_format(frame: CameraFrame, other: CameraFrame) -> bool:
    return frame.pixels.shape == other.pixels.shape and frame.pixels.dtype == other.pixels.dtype
