"""Tables of text, read only."""

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableWidget, QTableWidgetItem

from rotemina.app.shell.language import translate

RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
_ROW = 22


class Table(QTableWidget):
    """Rows of text under a head of marked texts; all columns but the first hold numbers."""

    def __init__(self, name: str, head: Sequence[str] = ()) -> None:
        super().__init__(0, len(head))
        self.setAccessibleName(name)
        self.setHorizontalHeaderLabels([translate("gap", text) for text in head])
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(_ROW)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)

    def set_head(self, head: Sequence[str]) -> None:
        """Name the columns anew."""
        self.setColumnCount(len(head))
        self.setHorizontalHeaderLabels([translate("gap", text) for text in head])

    def show_rows(
        self, rows: Sequence[Sequence[str]], colours: Sequence[QColor | None] = ()
    ) -> None:
        """Show rows in place of the last, each in its colour where one is given."""
        self.blockSignals(True)
        self.setRowCount(len(rows))
        for row, texts in enumerate(rows):
            for column, text in enumerate(texts):
                item = QTableWidgetItem(text)
                if column:
                    item.setTextAlignment(RIGHT)
                if row < len(colours) and colours[row] is not None:
                    item.setForeground(colours[row])
                self.setItem(row, column, item)
        self.blockSignals(False)

    def texts(self) -> list[list[str]]:
        """Return what is shown."""
        columns = range(self.columnCount())
        return [
            [self.item(row, column).text() for column in columns] for row in range(self.rowCount())
        ]
