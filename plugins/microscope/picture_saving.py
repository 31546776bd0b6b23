"""Saving of pictures and videos."""

from collections.abc import Callable
from datetime import datetime
from pathlib import Path

from rotemina.app.cameras.snapshot import Circumstances, program, write_png, write_tiff
from rotemina.app.cameras.video import Video, VideoStatus
from rotemina.app.microscope.errors import MicroscopeError
from rotemina.app.microscope.microscope import Microscope
from rotemina.app.microscope.status import MicroscopeStatus
from rotemina.app.motion.recording.session_recorder import SessionRecorder
from rotemina.app.motion.state import SessionState
from rotemina.drivers.cameras.frame import Frame
from rotemina.plugins.microscope import tr
from rotemina.plugins.microscope.contrast import Contrast, as_rgb, levels, shown

STAMP = "%Y-%m-%d_%H-%M-%S-%f"


def circumstances(
    status: MicroscopeStatus, state: SessionState, now: datetime, recording: str = ""
) -> Circumstances:
    """Return the present circumstances of a picture."""
    return Circumstances(
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
    """Make a folder of pictures, if it is not there yet.

    Raises
    ------
    MicroscopeError
        If it cannot be made.
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
    folder: Path, frame: Frame, contrast: Contrast, about: Circumstances, name: str
) -> tuple[Path, Path]:
    """Write the camera's numbers as TIFF, and what is seen as PNG; return where.

    Raises
    ------
    FileWriteError
        If one cannot be written; then that one is not there.
    MicroscopeError
        If the folder cannot be made.
    """
    make_folder(folder)
    tiff, png = folder / f"{name}.tif", folder / f"{name}.png"
    write_tiff(tiff, frame, about)
    write_png(png, as_rgb(shown(frame, contrast, levels(frame, contrast))), frame, about)
    return tiff, png


class VideoCapture:
    """At most one film of the camera in use; begun by hand, or with the session's recording.

    Parameters
    ----------
    microscope : Microscope
    folder : Path
        Of films.
    tell : callable
        Gets what the operator must know, on any thread.
    now : callable
        Date and time, for people.
    """

    def __init__(
        self,
        microscope: Microscope,
        folder: Path,
        tell: Callable[[str], None],
        now: Callable[[], datetime] = lambda: datetime.now().astimezone(),
    ) -> None:
        self._microscope, self._folder = microscope, folder
        self._tell, self._now = tell, now
        self.video: Video | None = None
        self._leave: Callable[[], None] = lambda: None
        #: Whether films begin and end with recordings.
        self.follows = False
        self._followed: SessionRecorder | None = None
        self._by_hand = False  # whether the film was there before the recording

    @property
    def status(self) -> VideoStatus | None:
        """The status of the running video, or None."""
        return None if self.video is None else self.video.status

    def begin(
        self, status: MicroscopeStatus, state: SessionState, recorder: SessionRecorder | None
    ) -> Path:
        """Begin a film, and return into which file.

        Raises
        ------
        MicroscopeError
            If there is one, or no picture.
        VideoError
            If no file can be made.
        """
        if self.video is not None:
            raise MicroscopeError(tr("a video is being recorded; end it first"))
        frame = status.feed.frame
        if frame is None:
            raise MicroscopeError(tr("there is no picture to record; open a camera first"))
        now = self._now()
        recording = "" if recorder is None else recorder.writer.path.name
        name = now.strftime(STAMP) if recorder is None else recorder.writer.path.stem
        path = _free(self._folder, name)
        about = circumstances(status, state, now, recording)
        facts = {
            "program": program(),
            "taken": about.taken,
            "camera": about.camera,
            "objective": about.objective,
            "pixel_m": about.pixel_m,
            "gain": about.gain,
            "recording": about.recording,
            "recording_began_s": None if recorder is None else recorder.writer.began_s,
        }
        video = Video(path, facts, pixel_m=status.pixel_m, tell=self._tell)
        video.start()
        self._leave = self._microscope.camera.listen(video.take)
        self.video = video
        if recorder is not None:
            recorder.note(f"video {path.name}")
        return path

    def end(self) -> Video:
        """End the film at this picture, and return it: it is for the caller to close it.

        Raises
        ------
        MicroscopeError
            If there is none.
        """
        video, self.video = self.video, None
        if video is None:
            raise MicroscopeError(tr("no video is being recorded"))
        self._leave()
        return video

    def due(self, recorder: SessionRecorder | None) -> bool | None:
        """Return whether to begin (True) or end (False) now, because a recording did.

        None: nothing is to be done. One that was begun by hand continues beside a recording.
        """
        before, self._followed = self._followed, recorder if self.follows else None
        if self._followed is not None and before is not self._followed:
            self._by_hand = self.video is not None
            return None if self._by_hand else True
        ended = before is not None and self._followed is None
        return False if ended and self.video is not None and not self._by_hand else None


def summary(path: Path, status: VideoStatus) -> str:
    """Return what has become of a film, in words."""
    text = tr("Saved {path}: {pictures} pictures of {seconds:.1f} s").format(
        path=path, pictures=status.pictures, seconds=status.lasts_s
    )
    return _with_dropped(text, status)


def progress(status: VideoStatus) -> str:
    """Return how a film does, in words."""
    text = tr("{pictures} pictures, {seconds:.0f} s, {megabytes:.0f} MB").format(
        pictures=status.pictures, seconds=status.lasts_s, megabytes=status.bytes_written / 1e6
    )
    return _with_dropped(text, status)


def _with_dropped(text: str, status: VideoStatus) -> str:
    if not status.dropped:
        return text
    return tr("{text}, {dropped} dropped").format(text=text, dropped=status.dropped)


def _free(folder: Path, name: str) -> Path:
    """Return a path that no film has yet: a recording may have several."""
    path, number = folder / f"{name}.tif", 2
    while path.exists():
        path, number = folder / f"{name}_{number}.tif", number + 1
    return path
