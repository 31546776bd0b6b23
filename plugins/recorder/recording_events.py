"""The events of the displayed recording; a click jumps to one."""

from bisect import bisect_right
from collections.abc import Sequence

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QPersistentModelIndex, Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QAbstractItemView, QCheckBox, QHeaderView, QTableView, QWidget

from rotemina.app.display_units import duration_text
from rotemina.app.recorded_events import Severity, TimelineEvent, timeline_events
from rotemina.app.shell.theme import Theme
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import named
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.plugins.recorder import mark, tr

COLUMNS = (mark("Time"), mark("Event"), mark("Text"))
Index = QModelIndex | QPersistentModelIndex
_NONE = QModelIndex()
_AFTER_S = 1e-6
# Kinds of events, as the engine names them.
KINDS = (
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
_EMPTY = mark("Open a recording to see what happened in it.")


class EventsModel(QAbstractTableModel):
    """Events by time; made for many thousands."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.events: tuple[TimelineEvent, ...] = ()
        self.use_theme(theme)

    def use_theme(self, theme: Theme) -> None:
        """Change the colours."""
        self.beginResetModel()
        self._colours = {
            Severity.GRAVE: QColor(theme.danger_text),
            Severity.WARNING: QColor(theme.warning),
            Severity.REMARK: QColor(theme.accent),
            Severity.DETAIL: QColor(theme.quiet),
        }
        self.endResetModel()

    def show_events(self, events: Sequence[TimelineEvent]) -> None:
        """Show others."""
        self.beginResetModel()
        self.events = tuple(events)
        self.endResetModel()

    def rowCount(self, parent: Index = _NONE) -> int:  # noqa: N802 (Qt's name)
        """Return how many there are."""
        return 0 if parent.isValid() else len(self.events)

    def columnCount(self, parent: Index = _NONE) -> int:  # noqa: N802 (Qt's name)
        """Return how many columns there are."""
        return 0 if parent.isValid() else len(COLUMNS)

    def headerData(  # noqa: N802 (Qt's name)
        self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole
    ) -> object:
        """Return what a column is called."""
        shown = role == Qt.ItemDataRole.DisplayRole and orientation is Qt.Orientation.Horizontal
        return tr(COLUMNS[section]) if shown else None

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> object:
        """Return text, tooltip and colour of a cell."""
        one = self.events[index.row()]
        if role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.AccessibleTextRole):
            return (duration_text(one.at_s, 2), tr(one.word), one.text)[index.column()]
        if role == Qt.ItemDataRole.ForegroundRole and index.column() == 1:
            return self._colours[one.weight]
        return None


class EventsView(QWidget):
    """The table, the row of the moment chosen, and a choice of how much is listed."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._replaying = workbench.replaying
        self._all: tuple[TimelineEvent, ...] = ()
        self.model = EventsModel(workbench.theme)
        self.table = _table(self.model)
        self.table.clicked.connect(lambda index: self.jump(index.row()))
        self.table.activated.connect(lambda index: self.jump(index.row()))
        self.details = QCheckBox(tr("with states and log"))
        self.details.setToolTip(tr("Also show states and log lines, not only actions and messages"))
        self.details.toggled.connect(self._choose)
        self.title = plain_text(tr(_EMPTY))
        head = in_row((self.title, 1), self.details)
        in_column(head, (self.table, 1), on=self, margins=0, spacing=4)
        workbench.replaying.changed.connect(self._begin)
        workbench.shown.connect(lambda _: self._follow())
        workbench.theme_changed.connect(self.model.use_theme)

    def jump(self, row: int) -> None:
        """Let the replay continue from just after an event."""
        if self._replaying.paced is not None:
            self._replaying.paced.seek(self.model.events[row].at_s + _AFTER_S)

    def _begin(self) -> None:
        paced = self._replaying.paced
        if paced is None:
            self._all = ()
        else:
            self._all = timeline_events(paced.replay.events, paced.replay.recording.began_s)
        self._choose()

    def _choose(self) -> None:
        details = self.details.isChecked()
        chosen = [one for one in self._all if details or one.weight is not Severity.DETAIL]
        self.model.show_events(chosen)
        if self._replaying.paced is None:
            self.title.setText(tr(_EMPTY))
        else:
            name = self._replaying.paced.replay.recording.path.name
            self.title.setText(
                tr("{name}: {n} of {all} events; click one to jump there").format(
                    name=name, n=len(chosen), all=len(self._all)
                )
            )

    def _follow(self) -> None:
        """Choose the row of what happened last."""
        paced = self._replaying.paced
        if paced is None or not self.isVisible():
            return
        row = bisect_right(self.model.events, paced.at_s, key=lambda one: one.at_s) - 1
        if row < 0:
            self.table.clearSelection()
        elif row != self.table.currentIndex().row() or not self.table.selectedIndexes():
            self.table.selectRow(row)


def _table(model: EventsModel) -> QTableView:
    table = named(QTableView(), tr("Events of the displayed recording"))
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
