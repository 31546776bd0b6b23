"""Two views of the records to choose from: a list with their gaps, and a menu for small pages."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QMenu,
    QToolButton,
    QTreeWidget,
    QTreeWidgetItem,
)

from rotemina.app.shell.records import ask_files, ask_records, format_moment, make_tooltip_lines
from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.widgets.style import OnVisible
from rotemina.app.workbench import Workbench
from rotemina.plugins.gap import mark, tr
from rotemina.plugins.gap.diagnosing.record_selection import ListedRecord, RecordSelection

FILE_FILTER = mark("Records (*.csv *.txt *.dat *.gz);;All files (*)")

# With at least this many records, each one can serve as validation data for a fit to the others.
_RECOMMENDED_RECORD_COUNT = 3

# The column has room for a gap such as "Z nano 88.8 µm".
_GAP_COLUMN_WIDTH_PX = 116


class RecordMenu(QToolButton):
    """Button with the number of ticked records, and a menu that ticks records and adds files."""

    def __init__(self, workbench: Workbench, records: RecordSelection) -> None:
        super().__init__()
        self._workbench, self._records = workbench, records
        self.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextOnly)
        menu = QMenu(self)
        menu.aboutToShow.connect(self._fill)
        self.setMenu(menu)
        self._fill()
        self._show_count()
        records.changed.connect(self._show_count)

    def ask(self) -> None:
        """Ask for records of the library, or for files if it is empty, and add them."""
        title, add_entries = tr("Records of the real machine"), self._records.add_entries
        ask_records(
            self.window(), self._workbench, title, add_entries, self.ask_files, multiple=True
        )

    def ask_files(self) -> None:
        """Ask for files, and add them."""
        title = tr("Records of the real machine")
        ask_files(self.window(), self._workbench, title, tr(FILE_FILTER), self._records.add_files)

    def _show_count(self) -> None:
        names = [record.full_name for record in self._records.chosen]
        count = len(names)
        text = tr("{n} records").format(n=count)
        if count < 2:
            text = tr("1 record") if count else tr("Records …")
        self.setText(text)
        advice = (
            tr("Three or more records of different motions give the best diagnosis.")
            if count < _RECOMMENDED_RECORD_COUNT
            else ""
        )
        lines = names or [tr("Choose the records of the real machine")]
        self.setToolTip(make_tooltip(tr("Records to diagnose:") if names else "", *lines, advice))

    def _fill(self) -> None:
        menu = self.menu()
        menu.clear()
        menu.addAction(tr("Add records …")).triggered.connect(self.ask)
        menu.addAction(tr("Add files …")).triggered.connect(self.ask_files)
        if self._records.listed:
            menu.addSeparator()
        for record in self._records.listed:
            text = "  ·  ".join(
                filter(None, (record.title, format_moment(record.began), record.gap))
            )
            # An "&" in a name must not mark a shortcut.
            action = QAction(text.replace("&", "&&"), menu)
            action.setCheckable(True)
            action.setChecked(record.ticked)
            action.toggled.connect(
                lambda is_checked, record=record: self._records.tick(record, ticked=is_checked)
            )
            menu.addAction(action)


class RecordList(QTreeWidget):
    """List of records: a check box, the name above the time, and the largest gap."""

    def __init__(self, records: RecordSelection) -> None:
        super().__init__()
        self._records = records
        self._shown_records: list[ListedRecord] = []
        self.setAccessibleName(tr("Records"))
        self.setRootIsDecorated(False)
        self.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
        self.setTextElideMode(Qt.TextElideMode.ElideMiddle)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setHeaderLabels([tr("Records"), tr("gap")])
        self.headerItem().setToolTip(
            1, tr("Gap from the model in use, of the axis with the most noise floors")
        )
        header = self.header()
        header.setStretchLastSection(False)
        header.setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        header.setSectionResizeMode(1, QHeaderView.ResizeMode.Fixed)
        header.resizeSection(1, _GAP_COLUMN_WIDTH_PX)
        self.itemChanged.connect(self._tick)
        fill_when_visible = OnVisible(self, self._fill)
        records.changed.connect(fill_when_visible)
        self._fill()

    def _fill(self) -> None:
        self.blockSignals(True)
        self.clear()
        self._shown_records = list(self._records.listed)
        for record in self._shown_records:
            item = QTreeWidgetItem(
                [f"{record.title}\n{format_moment(record.began)}".strip(), record.gap]
            )
            item.setCheckState(
                0, Qt.CheckState.Checked if record.ticked else Qt.CheckState.Unchecked
            )
            item.setTextAlignment(1, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
            lines = make_tooltip_lines(record.entry) if record.entry else (record.full_name,)
            item.setToolTip(0, make_tooltip(*lines))
            self.addTopLevelItem(item)
        self.blockSignals(False)

    def _tick(self, item: QTreeWidgetItem, _column: int) -> None:
        record = self._shown_records[self.indexOfTopLevelItem(item)]
        self._records.tick(record, ticked=item.checkState(0) is Qt.CheckState.Checked)
