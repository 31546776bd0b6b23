"""Saving of pictures and videos to files."""

from collections.abc import Callable
from datetime import datetime
from pathlib import Path

from rotemina.app.cameras import (
    SnapshotMetadata,
    VideoRecorder,
    VideoStatus,
    format_program_version,
    write_png,
    write_tiff,
)
from rotemina.app.errors import MicroscopeError
from rotemina.app.microscope import Microscope, MicroscopeStatus
from rotemina.app.motion.recording import SessionRecorder
from rotemina.app.motion.state import SessionState
from rotemina.drivers.cameras import CameraFrame
from rotemina.plugins.microscope import tr
from rotemina.plugins.microscope.contrast import (
    ContrastSettings,
    compute_levels,
    render_frame,
    to_rgb,
)

TIME_STAMP_FORMAT = "%Y-%m-%d_%H-%M-%S-%f"


def make_circumstances(
    status: MicroscopeStatus, state: SessionState, now: datetime, recording: str = ""
) -> SnapshotMetadata:
    """Return the metadata of a picture that is taken now."""
    return SnapshotMetadata(
        taken=now.isoformat(timespec="milliseconds"),
        camera="" if status.camera is None else f"{status.camera.name} ({status.camera.key})",
        objective=status.objective,
        gain=status.feed.settings.gain,
        pixel_m=status.pixel_m,
        command=dict(state.command),
        measured=dict(state.measured),
        recording=recording,
    )


def make_folder(folder: Path) -> None:
    """Create a folder, unless it exists.

    Raises
    ------
    MicroscopeError
        If it cannot be created.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise MicroscopeError(
            tr("{folder}: the folder cannot be created ({reason})").format(
                folder=folder, reason=error.strerror or error
            )
        ) from error


def write_pictures(
    folder: Path,
    frame: CameraFrame,
    contrast: ContrastSettings,
    metadata: SnapshotMetadata,
    name: str,
) -> tuple[Path, Path]:
    """Write the pixel values as TIFF and the displayed colours as PNG; return both paths.

    Raises
    ------
    FileWriteError
        If a file cannot be written. That file then does not exist.
    MicroscopeError
        If the folder cannot be created.
    """
    make_folder(folder)
    tiff, png = folder / f"{name}.tif", folder / f"{name}.png"
    write_tiff(tiff, frame, metadata)
    write_png(
        png,
        to_rgb(render_frame(frame, contrast, compute_levels(frame, contrast))),
        frame,
        metadata,
    )
    return tiff, png


class VideoCapture:
    """Video capture of the camera in use, started by hand or with a recording.

    At most one video runs at a time.

    Parameters
    ----------
    microscope : Microscope
    folder : Path
        Folder of the videos.
    notify : callable
        Called with warnings for the operator, on any thread.
    now : callable
        Returns date and time, for file names and descriptions.
    """

    def __init__(
        self,
        microscope: Microscope,
        folder: Path,
        notify: Callable[[str], None],
        now: Callable[[], datetime] = lambda: datetime.now().astimezone(),
    ) -> None:
        self._microscope, self._folder = microscope, folder
        self._notify, self._now = notify, now
        self.video: VideoRecorder | None = None
        self._unsubscribe: Callable[[], None] = lambda: None
        #: Whether videos start and end with recordings.
        self.follows_recordings = False
        self._followed_recorder: SessionRecorder | None = None
        # Whether the running video had been started before the recording.
        self._was_started_by_hand = False

    @property
    def status(self) -> VideoStatus | None:
        """The status of the running video, or None."""
        return None if self.video is None else self.video.status

    def begin(
        self, status: MicroscopeStatus, state: SessionState, recorder: SessionRecorder | None
    ) -> Path:
        """Start a video and return its path.

        Raises
        ------
        MicroscopeError
            If a video is running, or there is no picture.
        VideoError
            If the file cannot be created.
        """
        if self.video is not None:
            raise MicroscopeError(tr("a video is being recorded; end it first"))
        frame = status.feed.frame
        if frame is None:
            raise MicroscopeError(tr("there is no picture to record; open a camera first"))
        now = self._now()
        recording = "" if recorder is None else recorder.writer.path.name
        name = now.strftime(TIME_STAMP_FORMAT) if recorder is None else recorder.writer.path.stem
        path = _find_free_path(self._folder, name)
        snapshot_metadata = make_circumstances(status, state, now, recording)
        metadata = {
            "program": format_program_version(),
            "taken": snapshot_metadata.taken,
            "camera": snapshot_metadata.camera,
            "objective": snapshot_metadata.objective,
            "pixel_m": snapshot_metadata.pixel_m,
            "gain": snapshot_metadata.gain,
            "recording": snapshot_metadata.recording,
            "recording_began_s": None if recorder is None else recorder.writer.began_s,
        }
        video = VideoRecorder(path, metadata, pixel_m=status.pixel_m, notify=self._notify)
        video.start()
        self._unsubscribe = self._microscope.camera.listen(video.queue_frame)
        self.video = video
        if recorder is not None:
            recorder.record_note(f"video {path.name}")
        return path

    def end(self) -> VideoRecorder:
        """End the video with the latest picture and return it. The caller must close it.

        Raises
        ------
        MicroscopeError
            If no video is running.
        """
        video, self.video = self.video, None
        if video is None:
            raise MicroscopeError(tr("no video is being recorded"))
        self._unsubscribe()
        return video

    def follow_recording(self, recorder: SessionRecorder | None) -> bool | None:
        """Return True if a video must start with a recording, False if it must end with one.

        Otherwise return None. A video that was started by hand continues
        independently of recordings.
        """
        previous, self._followed_recorder = (
            self._followed_recorder,
            recorder if self.follows_recordings else None,
        )
        if self._followed_recorder is not None and previous is not self._followed_recorder:
            self._was_started_by_hand = self.video is not None
            return None if self._was_started_by_hand else True
        has_ended = previous is not None and self._followed_recorder is None
        return (
            False
            if has_ended and self.video is not None and not self._was_started_by_hand
            else None
        )


def describe_video(path: Path, status: VideoStatus) -> str:
    """Return path, length and lost pictures of a finished video as text."""
    text = tr("Saved {path}: {pictures} pictures of {seconds:.1f} s").format(
        path=path, pictures=status.pictures, seconds=status.duration_s
    )
    return _append_dropped(text, status)


def format_progress(status: VideoStatus) -> str:
    """Return length, size and lost pictures of the running video as text."""
    text = tr("{pictures} pictures, {seconds:.0f} s, {megabytes:.0f} MB").format(
        pictures=status.pictures, seconds=status.duration_s, megabytes=status.bytes_written / 1e6
    )
    return _append_dropped(text, status)


def _append_dropped(text: str, status: VideoStatus) -> str:
    if not status.dropped:
        return text
    return tr("{text}, {dropped} dropped").format(text=text, dropped=status.dropped)


def _find_free_path(folder: Path, name: str) -> Path:
    path, number = folder / f"{name}.tif", 2
    while path.exists():
        path, number = folder / f"{name}_{number}.tif", number + 1
    return path
