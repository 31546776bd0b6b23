"""The library of records as a table that can be searched: one for every place that needs it."""

from collections.abc import Sequence

from PySide6.QtCore import (
    QAbstractTableModel,
    QItemSelectionModel,
    QModelIndex,
    QPersistentModelIndex,
    Qt,
    Signal,
)
from PySide6.QtGui import QColor, QShowEvent
from PySide6.QtWidgets import (
    QAbstractItemDelegate,
    QAbstractItemView,
    QComboBox,
    QHBoxLayout,
    QHeaderView,
    QLineEdit,
    QTableView,
    QWidget,
)

from rotemina.app.motion.run_labels import one_line
from rotemina.app.records.entry import Entry, Kind, search
from rotemina.app.shell.language import translate
from rotemina.app.shell.record_words import (
    BEGAN,
    COLUMNS,
    GAP,
    KINDS,
    LENGTH,
    NAME,
    NOTE,
    cells,
    state_text,
    tip_lines,
)
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import plain_tip

# What all columns but the last have room for, whatever the size of the text.
_WIDEST = (
    "series 3: six_axis_tour",
    "2026-12-24 00:00:00",
    "0:00:00.0",
    "Z nano 888 µm",
    "the dish was too dry",
    "oocyte 123",
    "A. Wissmann",
    "zn hysteresis, z",
    "corrected-12345678",
    "RoTeMiNa, simulator",
    "888 MB",
    "recording",
)
MOST_NOTE = 1000  # letters
_ROW, _MARGIN = 22, 14  # px
_SORTED = {
    NAME: lambda one: one.name.casefold(),
    BEGAN: lambda one: one.age,
    LENGTH: lambda one: one.duration_s or 0.0,
    GAP: lambda one: (one.gap.unit, one.gap.rms) if one.gap else ("", 0.0),
}
_Index = QModelIndex | QPersistentModelIndex
_Role = Qt.ItemDataRole


class _Model(QAbstractTableModel):
    """Entries by row; name and note can be changed."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self.entries: tuple[Entry, ...] = ()
        self._bench = workbench
        self._texts: dict[int, tuple[str, ...]] = {}  # of rows that were shown
        self._order = BEGAN, Qt.SortOrder.DescendingOrder

    def show(self, entries: Sequence[Entry]) -> None:
        """Show other entries."""
        self.beginResetModel()
        column, order = self._order
        down = order is Qt.SortOrder.DescendingOrder
        self.entries = tuple(sorted(entries, key=_SORTED[column], reverse=down))
        self._texts = {}
        self.endResetModel()

    def sort(self, column: int, order: Qt.SortOrder = Qt.SortOrder.AscendingOrder) -> None:
        """Sort by a column, where that makes sense."""
        if column in _SORTED:
            self._order = column, order
            self.show(self.entries)

    def rowCount(self, parent: _Index = QModelIndex()) -> int:  # noqa: B008, N802 (Qt's)
        """Return how many there are."""
        return 0 if parent.isValid() else len(self.entries)

    def columnCount(self, parent: _Index = QModelIndex()) -> int:  # noqa: B008, N802 (Qt's)
        """Return how many columns there are."""
        return 0 if parent.isValid() else len(COLUMNS)

    def headerData(  # noqa: N802 (Qt's name)
        self, section: int, way: Qt.Orientation, role: int = _Role.DisplayRole
    ) -> object:
        """Return the head of a column."""
        if way is Qt.Orientation.Horizontal and role == _Role.DisplayRole:
            return translate("shell", COLUMNS[section])
        if role == _Role.ToolTipRole and section == GAP:
            return translate(
                "shell",
                "Gap from the model in use at that time, of the axis with the most noise floors",
            )
        return None

    def data(self, index: _Index, role: int = _Role.DisplayRole) -> object:
        """Return what a cell shows."""
        one = self.entries[index.row()]
        if role in (_Role.DisplayRole, _Role.EditRole):
            if index.row() not in self._texts:
                self._texts[index.row()] = cells(one)
            return self._texts[index.row()][index.column()]
        if role == _Role.ToolTipRole:
            return plain_tip(*tip_lines(one))
        if role == _Role.ForegroundRole and index.column() == NAME and state_text(one):
            theme = self._bench.theme
            return QColor(theme.warning if one.usable else theme.danger_text)
        if role == _Role.TextAlignmentRole and index.column() in (LENGTH, GAP):
            return int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        return None

    def flags(self, index: _Index) -> Qt.ItemFlag:
        """Let name and note be changed."""
        flags = super().flags(index)
        return flags | Qt.ItemFlag.ItemIsEditable if index.column() in (NAME, NOTE) else flags

    def setData(self, index: _Index, value: object, role: int = _Role.EditRole) -> bool:  # noqa: N802
        """Call a record otherwise, or note something else of it."""
        one, text = self.entries[index.row()], one_line(str(value), MOST_NOTE)
        if role != _Role.EditRole or text == cells(one)[index.column()]:
            return False
        if index.column() == NOTE:
            self._bench.library.call(one, note=text)
        elif text:
            self._bench.library.call(one, name=text)
        return True


class RecordTable(QTableView):
    """Records, newest first; a double click opens one, or changes its note.

    ``search`` and ``kinds`` are what narrows it, to stand wherever there is room.

    Signals
    -------
    opened(Entry)
    chosen_changed()
    """

    opened = Signal(object)
    chosen_changed = Signal()

    def __init__(
        self, workbench: Workbench, *, multiple: bool = False, usable_only: bool = False
    ) -> None:
        super().__init__()
        self._bench, self._usable_only = workbench, usable_only
        self.entries_model = _Model(workbench)
        self.setModel(self.entries_model)
        self.search, self.kinds = QLineEdit(), QComboBox()
        self._fitted_to = ""  # the font
        self._make_filter()
        self._set_up(multiple=multiple)
        self.doubleClicked.connect(self._double_clicked)
        self.selectionModel().selectionChanged.connect(lambda *_: self.chosen_changed.emit())
        workbench.library.changed.connect(self._fill)
        workbench.theme_changed.connect(self._repaint)  # a lambda would outlive the table
        self._fill()

    @property
    def chosen(self) -> tuple[Entry, ...]:
        """The records of the chosen rows, from above."""
        rows = sorted({index.row() for index in self.selectionModel().selectedRows()})
        return tuple(self.entries_model.entries[row] for row in rows)

    def filter_row(self) -> QWidget:
        """Return search and kinds in a row."""
        row = QWidget()
        line = QHBoxLayout(row)
        line.setContentsMargins(0, 0, 0, 0)
        line.addWidget(self.search, 1)
        line.addWidget(self.kinds)
        return row

    def rename(self, column: int) -> None:
        """Change name or note of the chosen record in its place."""
        index = self.entries_model.index(self.currentIndex().row(), column)
        if index.isValid():
            self.scrollTo(index)
            self.edit(index)

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 (Qt's name)
        """Make columns as wide as their texts, whenever those are of another size."""
        super().showEvent(event)
        if self._fitted_to != self.font().key():
            self._fitted_to = self.font().key()
            head = self.horizontalHeader()
            for column, text in enumerate(_WIDEST):
                width = self.fontMetrics().horizontalAdvance(text) + _MARGIN
                self.setColumnWidth(column, max(width, head.sectionSizeHint(column)))

    def _repaint(self) -> None:
        self.viewport().update()

    def _make_filter(self) -> None:
        self.search.setPlaceholderText(translate("shell", "Search"))
        self.search.setClearButtonEnabled(True)
        self.search.setAccessibleName(translate("shell", "Search the records"))
        self.search.setToolTip(
            translate(
                "shell",
                "Words of name, note, run, operator, sample, machine, model, effects, date or file",
            )
        )
        self.search.textChanged.connect(lambda _: self._fill())
        self.kinds.setAccessibleName(translate("shell", "Kind of the records"))
        self.kinds.setToolTip(translate("shell", "Kind of records to list"))
        self.kinds.addItem(translate("shell", "All records"), None)
        for kind, (_, several) in KINDS.items():
            self.kinds.addItem(translate("shell", several), kind)
        self.kinds.setSizeAdjustPolicy(
            QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
        )
        self.kinds.setMinimumContentsLength(12)
        self.kinds.currentIndexChanged.connect(lambda _: self._fill())

    def _set_up(self, *, multiple: bool) -> None:
        self.setAccessibleName(translate("shell", "Records, newest first"))
        modes = QAbstractItemView.SelectionMode
        self.setSelectionMode(modes.ExtendedSelection if multiple else modes.SingleSelection)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setTabKeyNavigation(False)
        self.setWordWrap(False)
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(_ROW)
        head = self.horizontalHeader()
        head.setSectionResizeMode(QHeaderView.ResizeMode.Interactive)
        head.setStretchLastSection(True)
        head.setHighlightSections(False)
        head.setSortIndicator(BEGAN, Qt.SortOrder.DescendingOrder)
        self.setSortingEnabled(True)

    def _fill(self) -> None:
        """Show what is searched for; what was chosen stays chosen."""
        kind = self.kinds.currentData()
        kinds = frozenset(Kind) if kind is None else {kind}
        found = search(self._bench.library.entries, self.search.text(), kinds)
        if self.state() is QAbstractItemView.State.EditingState:
            return  # what is being typed would be gone; it is filled afterwards
        if self._usable_only:
            found = tuple(one for one in found if one.usable)
        if found == self.entries_model.entries:
            return
        chosen = {one.id for one in self.chosen}
        self.entries_model.show(found)
        mode = QItemSelectionModel.SelectionFlag.Select | QItemSelectionModel.SelectionFlag.Rows
        shown = enumerate(self.entries_model.entries) if chosen else ()
        for row in [row for row, one in shown if one.id in chosen]:
            index = self.entries_model.index(row, 0)
            self.selectionModel().select(index, mode)
            self.selectionModel().setCurrentIndex(index, QItemSelectionModel.SelectionFlag.NoUpdate)
        self.chosen_changed.emit()

    def closeEditor(  # noqa: N802 (Qt's name)
        self, editor: QWidget, hint: QAbstractItemDelegate.EndEditHint
    ) -> None:
        """Show what has come while someone was typing."""
        super().closeEditor(editor, hint)
        self._fill()

    def _double_clicked(self, index: QModelIndex) -> None:
        if index.column() == NOTE:
            self.edit(index)
        else:
            self._open(index)

    def _open(self, index: QModelIndex) -> None:
        if index.isValid():
            self.opened.emit(self.entries_model.entries[index.row()])
