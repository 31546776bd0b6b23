"""Table of the events of the displayed recording. A click on an event jumps to it."""

from bisect import bisect_right
from collections.abc import Sequence

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QPersistentModelIndex, Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QAbstractItemView, QCheckBox, QHeaderView, QTableView, QWidget

from rotemina.app.language import format_duration
from rotemina.app.records import (
    EventSeverity,
    TimelineEvent,
    make_timeline_events,
)
from rotemina.app.widgets.controls import name_widget
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.style import Theme
from rotemina.app.widgets.text import make_plain_label
from rotemina.app.workbench import Workbench
from rotemina.plugins.recorder import mark, tr

COLUMN_TITLES = (mark("Time"), mark("Event"), mark("Text"))
ModelIndex = QModelIndex | QPersistentModelIndex
_NO_PARENT = QModelIndex()
# A jump leads to just after the event, so that the replay includes the event.
_JUMP_OFFSET_S = 1e-6
# The names of the kinds of events come from the engine. They are marked here for translation.
EVENT_KINDS = (
    mark("Fault"),
    mark("Stop"),
    mark("Refused"),
    mark("Recorder"),
    mark("Note"),
    mark("Action"),
    mark("Playback begins"),
    mark("Playback ends"),
    mark("Connection"),
    mark("State"),
    mark("Log"),
)
_EMPTY_TEXT = mark("Open a recording to see what happened in it.")


class EventsModel(QAbstractTableModel):
    """Table model of events in chronological order, fast enough for many thousands."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.events: tuple[TimelineEvent, ...] = ()
        self.set_theme(theme)

    def set_theme(self, theme: Theme) -> None:
        """Use the colours of a theme."""
        self.beginResetModel()
        self._colours = {
            EventSeverity.GRAVE: QColor(theme.danger_text),
            EventSeverity.WARNING: QColor(theme.warning),
            EventSeverity.REMARK: QColor(theme.accent),
            EventSeverity.DETAIL: QColor(theme.quiet),
        }
        self.endResetModel()

    def show_events(self, events: Sequence[TimelineEvent]) -> None:
        """Show other events."""
        self.beginResetModel()
        self.events = tuple(events)
        self.endResetModel()

    def rowCount(self, parent: ModelIndex = _NO_PARENT) -> int:  # noqa: N802 (Qt's name)
        """Return the number of events."""
        return 0 if parent.isValid() else len(self.events)

    def columnCount(self, parent: ModelIndex = _NO_PARENT) -> int:  # noqa: N802 (Qt's name)
        """Return the number of columns."""
        return 0 if parent.isValid() else len(COLUMN_TITLES)

    def headerData(  # noqa: N802 (Qt's name)
        self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole
    ) -> object:
        """Return the title of a column."""
        is_title = role == Qt.ItemDataRole.DisplayRole and orientation is Qt.Orientation.Horizontal
        return tr(COLUMN_TITLES[section]) if is_title else None

    def data(self, index: ModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> object:
        """Return the text or the colour of a cell."""
        event = self.events[index.row()]
        if role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.AccessibleTextRole):
            return (format_duration(event.at_s, 2), tr(event.word), event.text)[index.column()]
        if role == Qt.ItemDataRole.ForegroundRole and index.column() == 1:
            return self._colours[event.severity]
        return None


class EventsView(QWidget):
    """View of the events. The current event of the replay is selected. Details can be hidden."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._replaying = workbench.replaying
        self._all_events: tuple[TimelineEvent, ...] = ()
        self.model = EventsModel(workbench.theme)
        self.table = _make_table(self.model)
        self.table.clicked.connect(lambda index: self.jump_to_event(index.row()))
        self.table.activated.connect(lambda index: self.jump_to_event(index.row()))
        self.details = QCheckBox(tr("with states and log"))
        self.details.setToolTip(tr("Also show states and log lines, not only actions and messages"))
        self.details.toggled.connect(self._filter_events)
        self.title = make_plain_label(tr(_EMPTY_TEXT))
        head_row = make_row((self.title, 1), self.details)
        make_column(head_row, (self.table, 1), on=self, margins=0, spacing=4)
        workbench.replaying.changed.connect(self._load_events)
        workbench.shown.connect(lambda _: self._select_current())
        workbench.theme_changed.connect(self.model.set_theme)

    def jump_to_event(self, row: int) -> None:
        """Continue the replay from just after an event."""
        if self._replaying.paced is not None:
            self._replaying.paced.seek(self.model.events[row].at_s + _JUMP_OFFSET_S)

    def _load_events(self) -> None:
        paced = self._replaying.paced
        if paced is None:
            self._all_events = ()
        else:
            self._all_events = make_timeline_events(
                paced.replay.events, paced.replay.recording.began_s
            )
        self._filter_events()

    def _filter_events(self) -> None:
        are_details_shown = self.details.isChecked()
        listed_events = [
            event
            for event in self._all_events
            if are_details_shown or event.severity is not EventSeverity.DETAIL
        ]
        self.model.show_events(listed_events)
        if self._replaying.paced is None:
            self.title.setText(tr(_EMPTY_TEXT))
        else:
            name = self._replaying.paced.replay.recording.path.name
            self.title.setText(
                tr("{name}: {n} of {all} events; click one to jump there").format(
                    name=name, n=len(listed_events), all=len(self._all_events)
                )
            )

    def _select_current(self) -> None:
        paced = self._replaying.paced
        if paced is None or not self.isVisible():
            return
        row = bisect_right(self.model.events, paced.position_s, key=lambda event: event.at_s) - 1
        if row < 0:
            self.table.clearSelection()
        elif row != self.table.currentIndex().row() or not self.table.selectedIndexes():
            self.table.selectRow(row)


def _make_table(model: EventsModel) -> QTableView:
    table = name_widget(QTableView(), tr("Events of the displayed recording"))
    table.setModel(model)
    table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
    table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
    table.setTabKeyNavigation(False)
    table.setWordWrap(False)
    table.verticalHeader().hide()
    table.verticalHeader().setDefaultSectionSize(22)
    header = table.horizontalHeader()
    header.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
    header.setStretchLastSection(True)
    table.setColumnWidth(0, 90)
    table.setColumnWidth(1, 120)
    return table
