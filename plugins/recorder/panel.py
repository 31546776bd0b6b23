"""Recorder panel: record a session, recover interrupted recordings, browse the library."""

from PySide6.QtGui import QShowEvent

from rotemina.app.language import marked, translate
from rotemina.app.panel import (
    Panel,
    PanelArea,
    offer_in_palette,
)
from rotemina.app.widgets.controls import TabNews
from rotemina.app.widgets.layout import make_column, make_row, make_scroll_area, make_tabs
from rotemina.app.widgets.style import grow_with_text
from rotemina.app.workbench import BackgroundWorker, Level, Workbench
from rotemina.plugins.recorder import tr
from rotemina.plugins.recorder.interrupted_files import InterruptedRecording, find_interrupted
from rotemina.plugins.recorder.interrupted_view import InterruptedRecordingsBox
from rotemina.plugins.recorder.recording_controls import RecordingSection
from rotemina.plugins.recorder.recording_events import EventsView
from rotemina.plugins.recorder.records_view import RecordsView
from rotemina.plugins.recorder.words import join_names

_EVENTS_TAB = 1
_RECORDING_WIDTH_PX = 240
# If a folder does not respond, the search delays closing by at most this time.
_CLOSE_TIMEOUT_S = 2.0


class RecorderPanel(Panel):
    """Panel with the recording, the library, and the events of the displayed recording."""

    title = marked("panels", "Recorder")
    area = PanelArea.BOTTOM
    order = 70
    help_page = "recording.md#in-the-window"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        # A separate background worker, so that slow searches do not delay dry runs.
        self._background = BackgroundWorker(self)
        self._has_warned = False
        self.recording = RecordingSection(workbench, self._background)
        self.interrupted = InterruptedRecordingsBox(workbench)
        self.recordings = RecordsView(workbench, self.interrupted)
        self.events = EventsView(workbench)
        self.tabs, self.views = make_tabs(
            tr("View"), {tr("Records"): self.recordings, tr("Events"): self.events}
        )
        self.news = TabNews(self.tabs)
        self._lay_out()
        offer_in_palette(self.recording.record)
        offer_in_palette(self.recording.note_button, safe_while_hidden=True)
        self.recording.changed.connect(self.refresh_recordings)
        self.interrupted.recovered.connect(self.refresh_recordings)
        self.recordings.refresh_requested.connect(self.refresh_recordings)
        workbench.replaying.changed.connect(self._mark_events)
        self.follow(lambda _: self.recording.refresh())
        workbench.closing.connect(lambda: self._background.end(_CLOSE_TIMEOUT_S))
        self.refresh_recordings()

    def refresh_recordings(self) -> None:
        """Refresh the library, and search for interrupted recordings in the background."""
        self.workbench.library.refresh()
        # A recording that is being started or ended would look like one of another program.
        if self.recording.busy:
            return
        folder, own_paths = self.workbench.operation.recordings, self.recording.own_paths
        self._background.run(
            "look",
            lambda: find_interrupted(folder, own_paths),
            self._on_interrupted_found,
            lambda message: self.workbench.notify(Level.ERROR, message, about=self, subject=self),
        )

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 (Qt's name)
        """Refresh, because other programs may have recorded meanwhile."""
        super().showEvent(event)
        self.refresh_recordings()

    def _on_interrupted_found(self, recordings: tuple[InterruptedRecording, ...]) -> None:
        self.workbench.settled.emit(self)
        if not self._has_warned:
            self._has_warned = True
            self._warn_of_interrupted(recordings)
        self.interrupted.show_interrupted(recordings)

    def _warn_of_interrupted(self, recordings: tuple[InterruptedRecording, ...]) -> None:
        """Warn once of interrupted recordings, because this panel may be hidden behind another."""
        names = [recording.path.name for recording in recordings if not recording.busy]
        if names:
            self.workbench.notify(
                Level.WARNING,
                tr("Interrupted recordings: {names}. Recover them in the panel {title}.").format(
                    names=join_names(names), title=translate("panels", self.title)
                ),
                about=self,
                # The subject is the name of the task that recovers them.
                subject="recover",
            )

    def _mark_events(self) -> None:
        if self.workbench.replaying.paced is not None:
            self.news.mark(_EVENTS_TAB)

    def _lay_out(self) -> None:
        scroll = make_scroll_area(self.recording)
        grow_with_text(scroll, scroll.setFixedWidth, _RECORDING_WIDTH_PX)
        head_row = make_row(self.tabs, (self.recordings.filter, 1))
        right = make_column(head_row, (self.views, 1), spacing=4)
        # At this size the panel just fits next to the control dock in 1280 px, also in German.
        make_row(scroll, (right, 1), on=self, margins=6, spacing=4)
