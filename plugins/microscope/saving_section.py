"""Buttons that save a picture or a video."""

from datetime import datetime

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QCheckBox

from rotemina.app.cameras.video import VideoStatus
from rotemina.app.microscope.microscope import Microscope
from rotemina.app.microscope.status import MicroscopeStatus
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.engine_words import error_text
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.changing_button import ChangingButton
from rotemina.app.widgets.controls import allow, button, plain_tip
from rotemina.app.widgets.labels import show_text
from rotemina.app.widgets.section import Section
from rotemina.plugins.microscope import tr
from rotemina.plugins.microscope.picture_saving import (
    STAMP,
    VideoCapture,
    circumstances,
    progress,
    summary,
    write_pictures,
)
from rotemina.plugins.microscope.picture_view import PictureView
from rotemina.sim.errors import InputError

FOLLOWS = "microscope.video_with_recording"


class SavingSection(Section):
    """Snapshot and video; what is slow is done in the background."""

    _told = Signal(str)

    def __init__(self, workbench: Workbench, microscope: Microscope, view: PictureView) -> None:
        super().__init__(tr("Save"))
        self._workbench, self._view = workbench, view
        data = workbench.operation.data
        self._pictures = data / "pictures"
        self._told.connect(lambda text: workbench.notify(Level.WARNING, text, about=self))
        self.filming = VideoCapture(microscope, data / "videos", self._told.emit)
        self.snapshot = button(tr("Snapshot"), self._snap)
        self.record = ChangingButton(tr("● Video"), tr("■ End video"), run=self._toggle)
        self.add_row(self.snapshot, self.record)
        self.said = self.add_text()
        self.follows = QCheckBox(tr("video with each recording"))
        self.follows.setToolTip(
            plain_tip(
                tr("Start and end a video with the recording of the session (panel Recorder)")
            )
        )
        self.follows.setChecked(bool(workbench.settings.get(FOLLOWS, False)))
        self.filming.follows = self.follows.isChecked()
        self.follows.toggled.connect(self._follow)
        self.column.addWidget(self.follows)
        self._where = self.add_text()
        self._where.setText(
            tr("Files are saved to pictures and videos in {data}.").format(data=data)
        )
        self._status, self._state = MicroscopeStatus(), workbench.session.snapshot()
        workbench.closing.connect(self._close)

    @property
    def needed(self) -> bool:
        """Whether a video runs, or one has to begin or end with a recording."""
        filming, recorder = self.filming, self._workbench.operation.recording
        return filming.video is not None or (filming.follows and recorder is not None)

    def refresh(self, status: MicroscopeStatus, state: SessionState) -> None:
        """Show how a film does, and follow the recording."""
        self._status, self._state = status, state
        due = self.filming.due(self._workbench.operation.recording)
        if due is True:
            self._begin()
        elif due is False:
            self._end()
        video = self.filming.status
        if video is not None and video.failure:
            self._end()
            video = None
        none = tr("there is no picture") if status.feed.frame is None else None
        allow(self.snapshot, none, tr("Save this picture: raw values as TIFF, the view as PNG"))
        on = video is not None
        self.record.show_meaning(tr("■ End video") if on else tr("● Video"))
        tip = tr("End the video") if on else tr("Record every picture, with its time, as a BigTIFF")
        allow(self.record, None if on else none, tip)
        show_text(self.said, progress(video) if video is not None else "")

    def _snap(self) -> None:
        frame = self._view.frame
        if frame is None:  # the camera was closed just before the press
            text = tr("No snapshot: there is no picture. Open a camera first.")
            self._workbench.notify(Level.WARNING, text, about=self)
            return
        now = datetime.now().astimezone()
        recorder = self._workbench.operation.recording
        recording = "" if recorder is None else recorder.writer.path.name
        about = circumstances(self._status, self._state, now, recording)
        contrast, name = self._view.contrast, now.strftime(STAMP)

        def done(paths: tuple[object, object]) -> None:
            self._workbench.notify(
                Level.GOOD, tr("Saved {tiff} and {png}.png").format(tiff=paths[0], png=name)
            )

        self._workbench.work(
            f"snapshot {name}",
            tr("Writing a picture …"),
            lambda: write_pictures(self._pictures, frame, contrast, about, name),
            done,
        )

    def _toggle(self) -> None:
        if self.filming.video is None:
            self._begin()
        else:
            self._end()

    def _begin(self) -> None:
        recorder = self._workbench.operation.recording
        self._workbench.ask(lambda: self.filming.begin(self._status, self._state, recorder))

    def _end(self) -> None:
        video = self.filming.end()

        def done(status: VideoStatus) -> None:
            level = Level.WARNING if status.failure or status.dropped else Level.GOOD
            self._workbench.notify(level, summary(video.path, status))

        self._workbench.work(
            f"end of {video.path.name}", tr("Ending the video …"), video.close, done
        )

    def _follow(self, on: bool) -> None:
        self.filming.follows = on
        self._workbench.settings.set(FOLLOWS, on)

    def _close(self) -> None:
        if self.filming.video is not None:
            try:
                self.filming.end().close()
            except InputError as error:
                self._workbench.notify(Level.ERROR, error_text(error), about=error)
