"""Buttons that save a picture or a video."""

from datetime import datetime

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QCheckBox

from rotemina.app.cameras import VideoStatus
from rotemina.app.language import describe_error
from rotemina.app.microscope import Microscope, MicroscopeStatus
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import (
    ChangingButton,
    enable_unless,
    make_button,
    make_tooltip,
)
from rotemina.app.widgets.layout import Section
from rotemina.app.widgets.text import show_or_hide_text
from rotemina.app.workbench import Level, Workbench
from rotemina.plugins.microscope import tr
from rotemina.plugins.microscope.picture_saving import (
    TIME_STAMP_FORMAT,
    VideoCapture,
    describe_video,
    format_progress,
    make_circumstances,
    write_pictures,
)
from rotemina.plugins.microscope.picture_view import PictureView
from rotemina.sim.errors import InputError

FOLLOW_SETTING = "microscope.video_with_recording"


class SavingSection(Section):
    """Section to save snapshots and videos. Slow work is done in the background."""

    _warning_raised = Signal(str)

    def __init__(self, workbench: Workbench, microscope: Microscope, view: PictureView) -> None:
        super().__init__(tr("Save"))
        self._workbench, self._view = workbench, view
        data_folder = workbench.operation.data
        self._pictures = data_folder / "pictures"
        self._warning_raised.connect(lambda text: workbench.notify(Level.WARNING, text, about=self))
        self.video_capture = VideoCapture(
            microscope, data_folder / "videos", self._warning_raised.emit
        )
        self.snapshot = make_button(tr("Snapshot"), self._save_snapshot)
        self.record = ChangingButton(tr("● Video"), tr("■ End video"), run=self._toggle_video)
        self.add_row(self.snapshot, self.record)
        self.status_label = self.add_text()
        self.follow_box = QCheckBox(tr("video with each recording"))
        self.follow_box.setToolTip(
            make_tooltip(
                tr("Start and end a video with the recording of the session (panel Recorder)")
            )
        )
        self.follow_box.setChecked(bool(workbench.settings.get(FOLLOW_SETTING, False)))
        self.video_capture.follows_recordings = self.follow_box.isChecked()
        self.follow_box.toggled.connect(self._set_following)
        self.column.addWidget(self.follow_box)
        self._folder_label = self.add_text()
        self._folder_label.setText(
            tr("Files are saved to pictures and videos in {data}.").format(data=data_folder)
        )
        self._status, self._state = MicroscopeStatus(), workbench.session.snapshot()
        workbench.closing.connect(self._close)

    @property
    def is_needed(self) -> bool:
        """Whether a video is running, or must start with the current recording."""
        capture, recorder = self.video_capture, self._workbench.operation.recording
        return capture.video is not None or (capture.follows_recordings and recorder is not None)

    def refresh(self, status: MicroscopeStatus, state: SessionState) -> None:
        """Show the progress of the video, and start or end it with a recording."""
        self._status, self._state = status, state
        must_run = self.video_capture.follow_recording(self._workbench.operation.recording)
        if must_run is True:
            self._begin_video()
        elif must_run is False:
            self._end_video()
        video = self.video_capture.status
        if video is not None and video.failure:
            self._end_video()
            video = None
        objection = tr("there is no picture") if status.feed.frame is None else None
        enable_unless(
            self.snapshot, objection, tr("Save this picture: raw values as TIFF, the view as PNG")
        )
        is_running = video is not None
        self.record.show_meaning(tr("■ End video") if is_running else tr("● Video"))
        tooltip = (
            tr("End the video")
            if is_running
            else tr("Record every picture, with its time, as a BigTIFF")
        )
        enable_unless(self.record, None if is_running else objection, tooltip)
        show_or_hide_text(self.status_label, format_progress(video) if video is not None else "")

    def _save_snapshot(self) -> None:
        frame = self._view.frame
        if frame is None:
            # The camera was closed just before the press.
            text = tr("No snapshot: there is no picture. Open a camera first.")
            self._workbench.notify(Level.WARNING, text, about=self)
            return
        now = datetime.now().astimezone()
        recorder = self._workbench.operation.recording
        recording = "" if recorder is None else recorder.writer.path.name
        metadata = make_circumstances(self._status, self._state, now, recording)
        contrast, name = self._view.contrast, now.strftime(TIME_STAMP_FORMAT)

        def on_saved(paths: tuple[object, object]) -> None:
            self._workbench.notify(
                Level.GOOD, tr("Saved {tiff} and {png}.png").format(tiff=paths[0], png=name)
            )

        self._workbench.work(
            f"snapshot {name}",
            tr("Writing a picture …"),
            lambda: write_pictures(self._pictures, frame, contrast, metadata, name),
            on_saved,
        )

    def _toggle_video(self) -> None:
        if self.video_capture.video is None:
            self._begin_video()
        else:
            self._end_video()

    def _begin_video(self) -> None:
        recorder = self._workbench.operation.recording
        self._workbench.run_request(
            lambda: self.video_capture.begin(self._status, self._state, recorder)
        )

    def _end_video(self) -> None:
        video = self.video_capture.end()

        def on_ended(status: VideoStatus) -> None:
            level = Level.WARNING if status.failure or status.dropped else Level.GOOD
            self._workbench.notify(level, describe_video(video.path, status))

        self._workbench.work(
            f"end of {video.path.name}", tr("Ending the video …"), video.close, on_ended
        )

    def _set_following(self, on: bool) -> None:
        self.video_capture.follows_recordings = on
        self._workbench.settings.set(FOLLOW_SETTING, on)

    def _close(self) -> None:
        if self.video_capture.video is not None:
            try:
                self.video_capture.end().close()
            except InputError as error:
                self._workbench.notify(Level.ERROR, describe_error(error), about=error)
