"""A dialog to choose records of the library while the window stays usable."""

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QVBoxLayout, QWidget

from rotemina.app.language import translate
from rotemina.app.records import LibraryEntry
from rotemina.app.shell.records.record_table import RecordTable
from rotemina.app.widgets.controls import enable_unless
from rotemina.app.workbench import Workbench

_SIZE_PX = 920, 460


def ask_records(
    parent: QWidget,
    workbench: Workbench,
    title: str,
    use: Callable[[tuple[LibraryEntry, ...]], object],
    other: Callable[[], object],
    *,
    multiple: bool = False,
) -> None:
    """Ask for records of the library; if it is empty, call ``other``, which asks for a file."""
    if any(entry.is_usable for entry in workbench.library.entries):
        RecordChooser(parent, workbench, title, use, other, multiple=multiple).show()
    else:
        other()


class RecordChooser(QDialog):
    """Searchable list of records to choose from.

    Parameters
    ----------
    parent : QWidget
    workbench : Workbench
    title : str
    use : callable
        Receives the chosen records.
    other : callable
        Asks for a file outside the library.
    multiple : bool
        Whether several records can be chosen.
    """

    def __init__(
        self,
        parent: QWidget,
        workbench: Workbench,
        title: str,
        use: Callable[[tuple[LibraryEntry, ...]], object],
        other: Callable[[], object],
        *,
        multiple: bool,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(title)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._use = use
        self.table = RecordTable(workbench, multiple=multiple, usable_only=True)
        self.buttons = QDialogButtonBox(
            QDialogButtonBox.StandardButton.Open | QDialogButtonBox.StandardButton.Cancel
        )
        self.open = self.buttons.button(QDialogButtonBox.StandardButton.Open)
        self.open.setText(translate("shell", "Open"))
        self.buttons.button(QDialogButtonBox.StandardButton.Cancel).setText(
            translate("shell", "Cancel")
        )
        self.other = self.buttons.addButton(
            translate("shell", "Other file …"), QDialogButtonBox.ButtonRole.ActionRole
        )
        self.other.clicked.connect(self.reject)
        self.other.clicked.connect(lambda: other())
        self.buttons.accepted.connect(self._accept)
        self.buttons.rejected.connect(self.reject)
        self.table.opened.connect(lambda _: self._accept())
        self.table.selection_changed.connect(self._enable_open)
        column = QVBoxLayout(self)
        column.addWidget(self.table.make_filter_row())
        column.addWidget(self.table, 1)
        column.addWidget(self.buttons)
        self.resize(*_SIZE_PX)
        self.table.search.setFocus()
        self._enable_open()
        workbench.library.refresh()

    def _enable_open(self) -> None:
        reason = translate("shell", "select a record in the table")
        tip = translate("shell", "Use the selected records")
        enable_unless(self.open, None if self.table.selected_entries else reason, tip)

    def _accept(self) -> None:
        entries = self.table.selected_entries
        if entries:
            self.accept()
            self._use(entries)
