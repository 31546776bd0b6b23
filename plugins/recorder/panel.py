"""The recorder: record a session, recover interrupted recordings, browse the library."""

from PySide6.QtGui import QShowEvent

from rotemina.app.panel import Area, Panel, offer_in_palette
from rotemina.app.shell.background import Background
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.app.widgets.scroll_areas import scrolled, tabbed
from rotemina.app.widgets.tab_dots import TabNews
from rotemina.app.widgets.when_dressed import grow_with_text
from rotemina.plugins.recorder import tr
from rotemina.plugins.recorder.interrupted_files import Unfinished, look
from rotemina.plugins.recorder.interrupted_view import UnfinishedBox
from rotemina.plugins.recorder.recording_controls import RecordingSection
from rotemina.plugins.recorder.recording_events import EventsView
from rotemina.plugins.recorder.records_view import RecordsView
from rotemina.plugins.recorder.words import listed

_EVENTS = 1  # a tab
_WIDTH = 240  # of the recording's own part, px
_CLOSING_S = 2.0  # that closing waits for a look into a folder that hangs


class RecorderPanel(Panel):
    """The recording beside the list of recordings and the events of the one that is shown."""

    title = marked("panels", "Recorder")
    area = Area.BOTTOM
    order = 70
    help_page = "recording.md#in-the-window"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        # Looks that nobody waits for, so that they keep no dry run waiting.
        self._background = Background(self)
        self._told = False
        self.recording = RecordingSection(workbench, self._background)
        self.unfinished = UnfinishedBox(workbench)
        self.recordings = RecordsView(workbench, self.unfinished)
        self.events = EventsView(workbench)
        self.tabs, self.views = tabbed(
            tr("View"), {tr("Records"): self.recordings, tr("Events"): self.events}
        )
        self.news = TabNews(self.tabs)
        self._lay_out()
        offer_in_palette(self.recording.record)
        offer_in_palette(self.recording.keep, safe_while_hidden=True)
        self.recording.changed.connect(self.look)
        self.unfinished.recovered.connect(self.look)
        self.recordings.looked_for.connect(self.look)
        workbench.replaying.changed.connect(self._mark_events)
        self.follow(lambda _: self.recording.refresh())
        workbench.closing.connect(lambda: self._background.end(_CLOSING_S))
        self.look()

    def look(self) -> None:
        """Look what the library has now, and what a crash has left, in the background."""
        self.workbench.library.refresh()
        if self.recording.busy:  # it looks as if another program did that; soon it is known
            return
        folder, own = self.workbench.operation.recordings, self.recording.own
        self._background.run(
            "look",
            lambda: look(folder, own),
            self._take,
            lambda message: self.workbench.notify(Level.ERROR, message, about=self, subject=self),
        )

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 (Qt's name)
        """Look again: other programs record, too."""
        super().showEvent(event)
        self.look()

    def _take(self, found: tuple[Unfinished, ...]) -> None:
        self.workbench.settled.emit(self)
        if not self._told:
            self._told = True
            self._tell(found)
        self.unfinished.show_unfinished(found)

    def _tell(self, found: tuple[Unfinished, ...]) -> None:
        """Say once what a crash has left: this panel may stand behind another."""
        names = [one.path.name for one in found if not one.busy]
        if names:
            self.workbench.notify(
                Level.WARNING,
                tr("Interrupted recordings: {names}. Recover them in the panel {title}.").format(
                    names=listed(names), title=translate("panels", self.title)
                ),
                about=self,
                subject="recover",  # the work that recovers them
            )

    def _mark_events(self) -> None:
        if self.workbench.replaying.paced is not None:
            self.news.mark(_EVENTS)

    def _lay_out(self) -> None:
        scroll = scrolled(self.recording)
        grow_with_text(scroll, scroll.setFixedWidth, _WIDTH)
        head = in_row(self.tabs, (self.recordings.filter, 1))
        right = in_column(head, (self.views, 1), spacing=4)
        # Beside the control dock it just fits 1280 px, in German too.
        in_row(scroll, (right, 1), on=self, margins=6, spacing=4)
