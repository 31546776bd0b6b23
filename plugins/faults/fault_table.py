"""The fault history as a table, newest first; selected rows can be copied."""

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QGuiApplication, QKeyEvent, QKeySequence
from PySide6.QtWidgets import QHeaderView, QTableWidgetItem

from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.controls import plain_tip
from rotemina.app.widgets.table import Table
from rotemina.plugins.faults import mark, tr
from rotemina.plugins.faults.fault_history import Entry, Kind, as_text

COLUMNS = (mark("Time"), mark("Fault"), mark("Reason"))
_CLOCK = 11  # where the time of day begins in the text of a time


class HistoryTable(Table):
    """One row for each entry."""

    def __init__(self) -> None:
        super().__init__(
            tr("Faults, newest first"), [tr(column) for column in COLUMNS], row_height=24
        )
        self._shown: list[Entry] = []  # by row
        self.setSelectionMode(self.SelectionMode.ExtendedSelection)
        self.setWordWrap(False)
        header = self.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        header.setStretchLastSection(True)
        self.setColumnWidth(0, 104)
        self.setColumnWidth(1, 120)

    def show_entries(self, entries: Sequence[Entry], theme: Theme) -> None:
        """Show entries, given oldest first; chosen rows stay chosen while others come."""
        wanted = list(reversed(entries))
        newest = self._shown[0].number if self._shown else -1
        new = [entry for entry in wanted if entry.number > newest]
        if wanted[len(new) :] == self._shown[: len(wanted) - len(new)]:
            for row in range(len(new)):
                self.insertRow(row)
        else:  # one of the rows has come again, and moves up
            self.clearSelection()
            new = wanted
        self.setRowCount(len(wanted))
        for row, entry in enumerate(new):
            self._fill(row, entry, theme)
        self._shown = wanted

    def use_theme(self, theme: Theme) -> None:
        """Show everything in other colours."""
        for row, entry in enumerate(self._shown):
            self._fill(row, entry, theme)

    def chosen(self) -> list[Entry]:
        """Return the entries of the chosen rows, oldest first."""
        rows = sorted({index.row() for index in self.selectedIndexes()}, reverse=True)
        return [self._shown[row] for row in rows]

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802 (Qt's name)
        """Copy the chosen rows."""
        if event.matches(QKeySequence.StandardKey.Copy):
            QGuiApplication.clipboard().setText(as_text(self.chosen()))
            return
        super().keyPressEvent(event)

    def _fill(self, row: int, entry: Entry, theme: Theme) -> None:
        colours = {
            Kind.FAULT: theme.danger_text,
            Kind.LOST: theme.danger_text,
            Kind.FAILED: theme.danger_text,
            Kind.REFUSED: theme.warning,
            Kind.STOP: theme.warning,
            Kind.RECOVERED: theme.good,
            Kind.INJECTED: theme.accent,
        }
        texts = (entry.time[_CLOCK:], tr(entry.kind), entry.shown)
        for column, text in enumerate(texts):
            item = QTableWidgetItem(text)
            item.setToolTip(plain_tip(entry.time if column == 0 else entry.shown))
            if column == 1:
                item.setForeground(QColor(colours.get(entry.kind, theme.quiet)))
            item.setFlags(item.flags() & ~Qt.ItemFlag.ItemIsEditable)
            self.setItem(row, column, item)
