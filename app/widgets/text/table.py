"""Read-only tables of text."""

from collections.abc import Container, Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableWidget, QTableWidgetItem

from rotemina.app.widgets.controls import make_tooltip
from rotemina.sim.compatibility import FormerMember, serve_former_names

RIGHT_ALIGNED = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter


class TextTable(QTableWidget):
    """Read-only table of text; rows are selectable by default."""

    def __init__(
        self, name: str, head: Sequence[str] = (), *, selectable: bool = True, row_height: int = 22
    ) -> None:
        super().__init__(0, len(head))
        self.setAccessibleName(name)
        self.setHorizontalHeaderLabels(list(head))
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(row_height)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        modes = QAbstractItemView.SelectionMode
        self.setSelectionMode(modes.SingleSelection if selectable else modes.NoSelection)
        self.setTabKeyNavigation(False)
        self.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)

    def set_headers(self, head: Sequence[str]) -> None:
        """Set the titles of the columns."""
        self.setColumnCount(len(head))
        self.setHorizontalHeaderLabels(list(head))

    def show_rows(
        self,
        rows: Sequence[Sequence[str]],
        colours: Sequence[QColor | None] = (),
        *,
        numeric_columns: Container[int] | None = None,
        tips: bool = False,
    ) -> None:
        """Replace the rows; a row has its colour from ``colours``, if there is one.

        The columns in ``numeric_columns`` (by default all but the first) are aligned to the right.
        With ``tips`` each cell has its full text as a tooltip.
        """
        self.blockSignals(True)
        self.setRowCount(len(rows))
        model = self.model()
        # Blocked, because otherwise the columns would be fitted again after every cell.
        model.blockSignals(True)
        for row, texts in enumerate(rows):
            for column, text in enumerate(texts):
                item = QTableWidgetItem(text)
                if column > 0 if numeric_columns is None else column in numeric_columns:
                    item.setTextAlignment(RIGHT_ALIGNED)
                if row < len(colours) and colours[row] is not None:
                    item.setForeground(colours[row])
                if tips:
                    item.setToolTip(make_tooltip(text))
                self.setItem(row, column, item)
        model.blockSignals(False)
        if rows:
            last_index = model.index(len(rows) - 1, self.columnCount() - 1)
            model.dataChanged.emit(model.index(0, 0), last_index)
        self.blockSignals(False)

    def read_texts(self) -> list[list[str]]:
        """Return the texts of all cells, row by row."""
        columns = range(self.columnCount())
        return [
            [self.item(row, column).text() for column in columns] for row in range(self.rowCount())
        ]

    # Former names, which work for one more release.
    set_head = FormerMember("set_headers")
    texts = FormerMember("read_texts")


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        RIGHT="RIGHT_ALIGNED",
        Table="TextTable",
    )
