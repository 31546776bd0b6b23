"""The records in two shapes: rows with ticks and gaps, and a menu where there is less room."""

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

from rotemina.app.shell.file_dialog import ask_files
from rotemina.app.shell.record_chooser import ask_records
from rotemina.app.shell.record_words import moment_text, tip_lines
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import plain_tip
from rotemina.app.widgets.when_seen import WhenSeen
from rotemina.plugins.gap import mark, tr
from rotemina.plugins.gap.records import Listed, Records

FILES = mark("Records (*.csv *.txt *.dat *.gz);;All files (*)")
_ENOUGH = 3  # each then serves as data that a fit has not seen
_GAP_WIDTH = 116  # px, of "Z nano 88.8 µm"


class RecordMenu(QToolButton):
    """Says how many records are ticked; its menu ticks them and adds files."""

    def __init__(self, workbench: Workbench, records: Records) -> None:
        super().__init__()
        self._workbench, self._records = workbench, records
        self.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextOnly)
        menu = QMenu(self)
        menu.aboutToShow.connect(self._fill)
        self.setMenu(menu)
        self._fill()
        self._show()
        records.changed.connect(self._show)

    def ask(self) -> None:
        """Ask for records of the library, where it has any, else for files; and add them."""
        title, add = tr("Records of the real machine"), self._records.add_entries
        ask_records(self.window(), self._workbench, title, add, self.ask_files, multiple=True)

    def ask_files(self) -> None:
        """Ask for files, and add them."""
        title = tr("Records of the real machine")
        ask_files(self.window(), self._workbench, title, tr(FILES), self._records.add_files)

    def _show(self) -> None:
        names = [each.full for each in self._records.chosen]
        count = len(names)
        text = tr("{n} records").format(n=count)
        if count < 2:
            text = tr("1 record") if count else tr("Records …")
        self.setText(text)
        few = (
            tr("Three or more records of different motions give the best diagnosis.")
            if count < _ENOUGH
            else ""
        )
        said = names or [tr("Choose the records of the real machine")]
        self.setToolTip(plain_tip(tr("Records to diagnose:") if names else "", *said, few))

    def _fill(self) -> None:
        menu = self.menu()
        menu.clear()
        menu.addAction(tr("Add records …")).triggered.connect(self.ask)
        menu.addAction(tr("Add files …")).triggered.connect(self.ask_files)
        if self._records.listed:
            menu.addSeparator()
        for one in self._records.listed:
            told = "  ·  ".join(filter(None, (one.title, moment_text(one.began), one.gap)))
            action = QAction(told.replace("&", "&&"), menu)  # a name marks no shortcut
            action.setCheckable(True)
            action.setChecked(one.ticked)
            action.toggled.connect(lambda on, one=one: self._records.tick(one, ticked=on))
            menu.addAction(action)


class RecordList(QTreeWidget):
    """For each record a tick, its name over its time, and the gap of the axis that departs most."""

    def __init__(self, records: Records) -> None:
        super().__init__()
        self._records = records
        self._shown: list[Listed] = []
        self.setAccessibleName(tr("Records"))
        self.setRootIsDecorated(False)
        self.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
        self.setTextElideMode(Qt.TextElideMode.ElideMiddle)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setHeaderLabels([tr("Records"), tr("gap")])
        self.headerItem().setToolTip(
            1, tr("Gap from the model in use, of the axis with the most noise floors")
        )
        head = self.header()
        head.setStretchLastSection(False)
        head.setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        head.setSectionResizeMode(1, QHeaderView.ResizeMode.Fixed)
        head.resizeSection(1, _GAP_WIDTH)
        self.itemChanged.connect(self._tick)
        fill = WhenSeen(self, self._fill)
        records.changed.connect(fill)
        self._fill()

    def _fill(self) -> None:
        self.blockSignals(True)
        self.clear()
        self._shown = list(self._records.listed)
        for one in self._shown:
            item = QTreeWidgetItem([f"{one.title}\n{moment_text(one.began)}".strip(), one.gap])
            item.setCheckState(0, Qt.CheckState.Checked if one.ticked else Qt.CheckState.Unchecked)
            item.setTextAlignment(1, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
            lines = tip_lines(one.entry) if one.entry else (one.full,)
            item.setToolTip(0, plain_tip(*lines))
            self.addTopLevelItem(item)
        self.blockSignals(False)

    def _tick(self, item: QTreeWidgetItem, _column: int) -> None:
        one = self._shown[self.indexOfTopLevelItem(item)]
        self._records.tick(one, ticked=item.checkState(0) is Qt.CheckState.Checked)
