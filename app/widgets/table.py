"""Tables of text, read only."""

from collections.abc import Container, Sequence

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableWidget, QTableWidgetItem

from rotemina.app.widgets.controls import plain_tip

RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter


class Table(QTableWidget):
    """A read-only table of text; rows are selectable by default."""

    def __init__(
        self, name: str, head: Sequence[str] = (), *, choose: bool = True, row_height: int = 22
    ) -> None:
        super().__init__(0, len(head))
        self.setAccessibleName(name)
        self.setHorizontalHeaderLabels(list(head))
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(row_height)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        modes = QAbstractItemView.SelectionMode
        self.setSelectionMode(modes.SingleSelection if choose else modes.NoSelection)
        self.setTabKeyNavigation(False)
        self.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)

    def set_head(self, head: Sequence[str]) -> None:
        """Name the columns again."""
        self.setColumnCount(len(head))
        self.setHorizontalHeaderLabels(list(head))

    def show_rows(
        self,
        rows: Sequence[Sequence[str]],
        colours: Sequence[QColor | None] = (),
        *,
        numbers: Container[int] | None = None,
        tips: bool = False,
    ) -> None:
        """Show rows in place of the last, each in its colour where one is given.

        The columns of ``numbers`` stand at the right, by default all but the first. With ``tips``
        each cell has all of its text as a tooltip.
        """
        self.blockSignals(True)
        self.setRowCount(len(rows))
        model = self.model()
        model.blockSignals(True)  # columns would be fitted to their contents at every cell
        for row, texts in enumerate(rows):
            for column, text in enumerate(texts):
                item = QTableWidgetItem(text)
                if column > 0 if numbers is None else column in numbers:
                    item.setTextAlignment(RIGHT)
                if row < len(colours) and colours[row] is not None:
                    item.setForeground(colours[row])
                if tips:
                    item.setToolTip(plain_tip(text))
                self.setItem(row, column, item)
        model.blockSignals(False)
        if rows:
            last = model.index(len(rows) - 1, self.columnCount() - 1)
            model.dataChanged.emit(model.index(0, 0), last)
        self.blockSignals(False)

    def texts(self) -> list[list[str]]:
        """Return what is shown."""
        columns = range(self.columnCount())
        return [
            [self.item(row, column).text() for column in columns] for row in range(self.rowCount())
        ]
