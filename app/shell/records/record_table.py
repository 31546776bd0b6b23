"""The searchable table of the record library, shared by all places that show it."""

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

from rotemina.app.language import translate
from rotemina.app.motion.state import to_one_line
from rotemina.app.records import (
    LibraryEntry,
    RecordKind,
    search_entries,
)
from rotemina.app.shell.records.record_words import (
    BEGAN_COLUMN,
    COLUMN_TITLES,
    GAP_COLUMN,
    KIND_NAMES,
    LENGTH_COLUMN,
    NAME_COLUMN,
    NOTE_COLUMN,
    describe_file_problem,
    make_cells,
    make_tooltip_lines,
)
from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.workbench import Workbench

# For each column but the last, a text that must fit into it at any text size.
_WIDEST_TEXTS = (
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
MAX_NOTE_LENGTH = 1000
_ROW_HEIGHT_PX, _MARGIN_PX = 22, 14
_SORT_KEYS = {
    NAME_COLUMN: lambda entry: entry.name.casefold(),
    BEGAN_COLUMN: lambda entry: entry.sort_key,
    LENGTH_COLUMN: lambda entry: entry.duration_s or 0.0,
    GAP_COLUMN: lambda entry: (entry.gap.unit, entry.gap.rms) if entry.gap else ("", 0.0),
}
_Index = QModelIndex | QPersistentModelIndex
_Role = Qt.ItemDataRole


class _RecordModel(QAbstractTableModel):
    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self.entries: tuple[LibraryEntry, ...] = ()
        self._bench = workbench
        # Cell texts by row, computed when a row is first shown.
        self._texts: dict[int, tuple[str, ...]] = {}
        self._sorting = BEGAN_COLUMN, Qt.SortOrder.DescendingOrder

    def show_entries(self, entries: Sequence[LibraryEntry]) -> None:
        """Replace the entries that are shown."""
        self.beginResetModel()
        column, order = self._sorting
        is_descending = order is Qt.SortOrder.DescendingOrder
        self.entries = tuple(sorted(entries, key=_SORT_KEYS[column], reverse=is_descending))
        self._texts = {}
        self.endResetModel()

    def sort(self, column: int, order: Qt.SortOrder = Qt.SortOrder.AscendingOrder) -> None:
        """Sort by a column that can be sorted."""
        if column in _SORT_KEYS:
            self._sorting = column, order
            self.show_entries(self.entries)

    def rowCount(self, parent: _Index = QModelIndex()) -> int:  # noqa: B008, N802 (Qt's)
        """Return the number of entries."""
        return 0 if parent.isValid() else len(self.entries)

    def columnCount(self, parent: _Index = QModelIndex()) -> int:  # noqa: B008, N802 (Qt's)
        """Return the number of columns."""
        return 0 if parent.isValid() else len(COLUMN_TITLES)

    def headerData(  # noqa: N802 (Qt's name)
        self, section: int, orientation: Qt.Orientation, role: int = _Role.DisplayRole
    ) -> object:
        """Return the title or tooltip of a column."""
        if orientation is Qt.Orientation.Horizontal and role == _Role.DisplayRole:
            return translate("shell", COLUMN_TITLES[section])
        if role == _Role.ToolTipRole and section == GAP_COLUMN:
            return translate(
                "shell",
                "Gap from the model in use at that time, of the axis with the most noise floors",
            )
        return None

    def data(self, index: _Index, role: int = _Role.DisplayRole) -> object:
        """Return the content of a cell for a role."""
        entry = self.entries[index.row()]
        if role in (_Role.DisplayRole, _Role.EditRole):
            if index.row() not in self._texts:
                self._texts[index.row()] = make_cells(entry)
            return self._texts[index.row()][index.column()]
        if role == _Role.ToolTipRole:
            return make_tooltip(*make_tooltip_lines(entry))
        if (
            role == _Role.ForegroundRole
            and index.column() == NAME_COLUMN
            and describe_file_problem(entry)
        ):
            theme = self._bench.theme
            return QColor(theme.warning if entry.is_usable else theme.danger_text)
        if role == _Role.TextAlignmentRole and index.column() in (LENGTH_COLUMN, GAP_COLUMN):
            return int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        return None

    def flags(self, index: _Index) -> Qt.ItemFlag:
        """Make name and note editable."""
        flags = super().flags(index)
        return (
            flags | Qt.ItemFlag.ItemIsEditable
            if index.column() in (NAME_COLUMN, NOTE_COLUMN)
            else flags
        )

    def setData(self, index: _Index, value: object, role: int = _Role.EditRole) -> bool:  # noqa: N802
        """Change the name or the note of a record."""
        entry, text = self.entries[index.row()], to_one_line(str(value), MAX_NOTE_LENGTH)
        if role != _Role.EditRole or text == make_cells(entry)[index.column()]:
            return False
        if index.column() == NOTE_COLUMN:
            self._bench.library.set_texts(entry, note=text)
        elif text:
            self._bench.library.set_texts(entry, name=text)
        return True


class RecordTable(QTableView):
    """Table of records, newest first; a double click opens a record or edits its note.

    The widgets ``search`` and ``kinds`` filter the table; they can be placed anywhere.

    Signals
    -------
    opened(LibraryEntry)
    selection_changed()
    """

    opened = Signal(object)
    selection_changed = Signal()

    def __init__(
        self, workbench: Workbench, *, multiple: bool = False, usable_only: bool = False
    ) -> None:
        super().__init__()
        self._bench, self._usable_only = workbench, usable_only
        self.entries_model = _RecordModel(workbench)
        self.setModel(self.entries_model)
        self.search, self.kinds = QLineEdit(), QComboBox()
        # The font to which the widths of the columns are fitted.
        self._fitted_font = ""
        self._make_filter()
        self._set_up(multiple=multiple)
        self.doubleClicked.connect(self._on_double_click)
        self.selectionModel().selectionChanged.connect(lambda *_: self.selection_changed.emit())
        workbench.library.changed.connect(self._fill)
        # A bound method, because a lambda would outlive the table.
        workbench.theme_changed.connect(self._repaint)
        self._fill()

    @property
    def selected_entries(self) -> tuple[LibraryEntry, ...]:
        """The records of the selected rows, from top to bottom."""
        rows = sorted({index.row() for index in self.selectionModel().selectedRows()})
        return tuple(self.entries_model.entries[row] for row in rows)

    def make_filter_row(self) -> QWidget:
        """Return the search field and the choice of kinds in one row."""
        row = QWidget()
        line = QHBoxLayout(row)
        line.setContentsMargins(0, 0, 0, 0)
        line.addWidget(self.search, 1)
        line.addWidget(self.kinds)
        return row

    def edit_cell(self, column: int) -> None:
        """Edit the name or note of the selected record in its cell."""
        index = self.entries_model.index(self.currentIndex().row(), column)
        if index.isValid():
            self.scrollTo(index)
            self.edit(index)

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 (Qt's name)
        """Fit the columns to their texts if the font has changed."""
        super().showEvent(event)
        if self._fitted_font != self.font().key():
            self._fitted_font = self.font().key()
            header = self.horizontalHeader()
            for column, text in enumerate(_WIDEST_TEXTS):
                width = self.fontMetrics().horizontalAdvance(text) + _MARGIN_PX
                self.setColumnWidth(column, max(width, header.sectionSizeHint(column)))

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
        for kind, (_, plural) in KIND_NAMES.items():
            self.kinds.addItem(translate("shell", plural), kind)
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
        self.verticalHeader().setDefaultSectionSize(_ROW_HEIGHT_PX)
        header = self.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.Interactive)
        header.setStretchLastSection(True)
        header.setHighlightSections(False)
        header.setSortIndicator(BEGAN_COLUMN, Qt.SortOrder.DescendingOrder)
        self.setSortingEnabled(True)

    def _fill(self) -> None:
        kind = self.kinds.currentData()
        kinds = frozenset(RecordKind) if kind is None else {kind}
        matches = search_entries(self._bench.library.entries, self.search.text(), kinds)
        if self.state() is QAbstractItemView.State.EditingState:
            # Filling the table would discard the text being typed, so it waits for closeEditor.
            return
        if self._usable_only:
            matches = tuple(entry for entry in matches if entry.is_usable)
        if matches == self.entries_model.entries:
            return
        selected_ids = {entry.id for entry in self.selected_entries}
        self.entries_model.show_entries(matches)
        select_row = (
            QItemSelectionModel.SelectionFlag.Select | QItemSelectionModel.SelectionFlag.Rows
        )
        rows = enumerate(self.entries_model.entries) if selected_ids else ()
        for row in [row for row, entry in rows if entry.id in selected_ids]:
            index = self.entries_model.index(row, 0)
            self.selectionModel().select(index, select_row)
            self.selectionModel().setCurrentIndex(index, QItemSelectionModel.SelectionFlag.NoUpdate)
        self.selection_changed.emit()

    def closeEditor(  # noqa: N802 (Qt's name)
        self, editor: QWidget, hint: QAbstractItemDelegate.EndEditHint
    ) -> None:
        """Show changes that arrived during editing."""
        super().closeEditor(editor, hint)
        self._fill()

    def _on_double_click(self, index: QModelIndex) -> None:
        if index.column() == NOTE_COLUMN:
            self.edit(index)
        else:
            self._open(index)

    def _open(self, index: QModelIndex) -> None:
        if index.isValid():
            self.opened.emit(self.entries_model.entries[index.row()])
