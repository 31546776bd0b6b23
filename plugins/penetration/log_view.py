"""The latest runs in a table, and all of the one that is chosen."""

from collections.abc import Iterable
from datetime import datetime

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QPlainTextEdit,
    QSplitter,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from rotemina.app.motion.penetration.run_log import PenetrationRun
from rotemina.app.shell.controls import ElidedLabel, plain_tip
from rotemina.app.shell.language import translate
from rotemina.plugins.penetration.runs import COLUMN_TIPS, COLUMNS, RunList, in_full, row

_NUMBERS = slice(2, 7)


class LogView(QWidget):
    """A table beside the text of one run."""

    def __init__(self, path: str) -> None:
        super().__init__()
        self.list = RunList()
        self.table = QTableWidget(0, len(COLUMNS))
        self.table.setAccessibleName(translate("penetration", "Runs, the latest first"))
        self.table.setHorizontalHeaderLabels([translate("penetration", one) for one in COLUMNS])
        for column, tip in enumerate(COLUMN_TIPS):
            self.table.horizontalHeaderItem(column).setToolTip(
                plain_tip(translate("penetration", tip))
            )
        self.table.verticalHeader().hide()
        self.table.verticalHeader().setDefaultSectionSize(24)
        self.table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.table.setTabKeyNavigation(False)
        header = self.table.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        header.setStretchLastSection(True)
        self.table.setMinimumSize(200, 60)
        self.table.itemSelectionChanged.connect(self._show_chosen)
        self.text = QPlainTextEdit()
        self.text.setReadOnly(True)
        self.text.setAccessibleName(translate("penetration", "All of the chosen run"))
        self.text.setToolTip(translate("penetration", "All that was logged of the chosen run"))
        self.text.setPlaceholderText(translate("penetration", "Choose a run to see all of it."))
        self.text.setMinimumWidth(160)
        split = QSplitter(Qt.Orientation.Horizontal)
        split.addWidget(self.table)
        split.addWidget(self.text)
        split.setSizes([620, 300])
        split.setChildrenCollapsible(False)
        self.file = ElidedLabel()
        self.file.setProperty("quiet", True)
        self.file.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._path = path
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(3)
        column.addWidget(split, 1)
        column.addWidget(self.file)
        self._fill()

    def take_file(self, runs: Iterable[PenetrationRun]) -> None:
        """Show the file's runs behind those of this start."""
        self.list.take_file(runs)
        self._fill()

    def take_latest(self, run: PenetrationRun | None) -> None:
        """Show a run that has just ended, if it is another."""
        if self.list.take_latest(run):
            self._fill()

    def _fill(self) -> None:
        now = datetime.now().astimezone()
        self.table.blockSignals(True)
        self.table.clearSelection()
        self.table.setRowCount(len(self.list.runs))
        for number, run in enumerate(self.list.runs):
            for column, text in enumerate(row(run, now)):
                item = QTableWidgetItem(text)
                item.setToolTip(plain_tip(text))
                if column in range(*_NUMBERS.indices(len(COLUMNS))):
                    item.setTextAlignment(
                        Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
                    )
                self.table.setItem(number, column, item)
        self.table.blockSignals(False)
        self.text.clear()
        count, ours = len(self.list.runs), self.list.of_this_start
        self.file.show_text(
            translate(
                "penetration", "{count} shown, {ours} of this start. Log file: {path}"
            ).format(count=count, ours=ours, path=self._path)
        )

    def _show_chosen(self) -> None:
        chosen = self.table.selectionModel().selectedRows()
        self.text.setPlainText(in_full(self.list.runs[chosen[0].row()]) if chosen else "")
