"""The fault history as a table, newest entry first. Selected rows can be copied."""

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QGuiApplication, QKeyEvent, QKeySequence
from PySide6.QtWidgets import QHeaderView, QTableWidgetItem

from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.widgets.style import Theme
from rotemina.app.widgets.text import TextTable
from rotemina.plugins.faults import mark, tr
from rotemina.plugins.faults.fault_history import FaultEntry, FaultKind, format_entries

COLUMN_TITLES = (mark("Time"), mark("Fault"), mark("Reason"))
# The index at which the time of day begins in the text of a date and time.
_TIME_OF_DAY_START = 11


class FaultTable(TextTable):
    """Table of the fault history with one row for each entry."""

    def __init__(self) -> None:
        super().__init__(
            tr("Faults, newest first"), [tr(column) for column in COLUMN_TITLES], row_height=24
        )
        self._shown_entries: list[FaultEntry] = []
        self.setSelectionMode(self.SelectionMode.ExtendedSelection)
        self.setWordWrap(False)
        header = self.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        header.setStretchLastSection(True)
        self.setColumnWidth(0, 104)
        self.setColumnWidth(1, 120)

    def show_entries(self, entries: Sequence[FaultEntry], theme: Theme) -> None:
        """Show entries, given oldest first. Selected rows stay selected when new entries appear."""
        entries_newest_first = list(reversed(entries))
        newest_number = self._shown_entries[0].number if self._shown_entries else -1
        new_entries = [entry for entry in entries_newest_first if entry.number > newest_number]
        old_count = len(entries_newest_first) - len(new_entries)
        if entries_newest_first[len(new_entries) :] == self._shown_entries[:old_count]:
            for row in range(len(new_entries)):
                self.insertRow(row)
        else:
            # An entry was repeated and has moved up, so all rows are filled again.
            self.clearSelection()
            new_entries = entries_newest_first
        self.setRowCount(len(entries_newest_first))
        for row, entry in enumerate(new_entries):
            self._fill_row(row, entry, theme)
        self._shown_entries = entries_newest_first

    def use_theme(self, theme: Theme) -> None:
        """Change the colours."""
        for row, entry in enumerate(self._shown_entries):
            self._fill_row(row, entry, theme)

    def list_selected_entries(self) -> list[FaultEntry]:
        """Return the entries of the selected rows, oldest first."""
        rows = sorted({index.row() for index in self.selectedIndexes()}, reverse=True)
        return [self._shown_entries[row] for row in rows]

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802 (Qt's name)
        """Copy the selected rows."""
        if event.matches(QKeySequence.StandardKey.Copy):
            QGuiApplication.clipboard().setText(format_entries(self.list_selected_entries()))
            return
        super().keyPressEvent(event)

    def _fill_row(self, row: int, entry: FaultEntry, theme: Theme) -> None:
        colours = {
            FaultKind.FAULT: theme.danger_text,
            FaultKind.LOST: theme.danger_text,
            FaultKind.CONNECTION_FAILED: theme.danger_text,
            FaultKind.REFUSED: theme.warning,
            FaultKind.STOP: theme.warning,
            FaultKind.RECOVERED: theme.good,
            FaultKind.INJECTED: theme.accent,
        }
        texts = (entry.time[_TIME_OF_DAY_START:], tr(entry.kind), entry.shown_text)
        for column, text in enumerate(texts):
            item = QTableWidgetItem(text)
            item.setToolTip(make_tooltip(entry.time if column == 0 else entry.shown_text))
            if column == 1:
                item.setForeground(QColor(colours.get(entry.kind, theme.quiet)))
            item.setFlags(item.flags() & ~Qt.ItemFlag.ItemIsEditable)
            self.setItem(row, column, item)
