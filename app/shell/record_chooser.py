"""A dialog that asks for records of the library, beside a window that can still be used."""

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QVBoxLayout, QWidget

from rotemina.app.records.entry import Entry
from rotemina.app.shell.language import translate
from rotemina.app.shell.record_table import RecordTable
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import allow

_SIZE = 920, 460  # px


def ask_records(
    parent: QWidget,
    workbench: Workbench,
    title: str,
    use: Callable[[tuple[Entry, ...]], object],
    other: Callable[[], object],
    *,
    multiple: bool = False,
) -> None:
    """Ask for records of the library; where it has none, ask for an ``other`` file at once."""
    if any(one.usable for one in workbench.library.entries):
        RecordChooser(parent, workbench, title, use, other, multiple=multiple).show()
    else:
        other()


class RecordChooser(QDialog):
    """Records to be searched, and what is done with the chosen ones.

    Parameters
    ----------
    parent : QWidget
    workbench : Workbench
    title : str
    use : callable
        Gets the chosen ones.
    other : callable
        Asks for a file that the library does not have.
    multiple : bool
    """

    def __init__(
        self,
        parent: QWidget,
        workbench: Workbench,
        title: str,
        use: Callable[[tuple[Entry, ...]], object],
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
        self.table.chosen_changed.connect(self._allow)
        column = QVBoxLayout(self)
        column.addWidget(self.table.filter_row())
        column.addWidget(self.table, 1)
        column.addWidget(self.buttons)
        self.resize(*_SIZE)
        self.table.search.setFocus()
        self._allow()
        workbench.library.refresh()

    def _allow(self) -> None:
        none = translate("shell", "select a record in the table")
        tip = translate("shell", "Use the selected records")
        allow(self.open, None if self.table.chosen else none, tip)

    def _accept(self) -> None:
        chosen = self.table.chosen
        if chosen:
            self.accept()
            self._use(chosen)
