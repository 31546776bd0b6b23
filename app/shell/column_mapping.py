"""The dialog that names the columns of a file without a header; its answer is remembered."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QHeaderView,
    QLabel,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from rotemina.app.shell.engine_words import error_text
from rotemina.app.shell.language import translate
from rotemina.app.shell.workbench import Workbench
from rotemina.sim.errors import InputError
from rotemina.sim.records.layout import parse_columns
from rotemina.sim.records.preview import Preview, preview
from rotemina.sim.robot.model import Robot, StepperAxis
from rotemina.sim.units import units_of

TIMES = ("t [s]", "t [ms]", "t [us]")


def ask_columns(
    path: Path, workbench: Workbench, parent: QWidget, use: Callable[[Path, str | None], None]
) -> None:
    """Call ``use`` with a file and, if it has no header of its own, the names of its columns.

    The file's beginning is read in the background. The names last given to a file of the same
    shape are offered again. Nothing happens if the dialog is cancelled; a file that cannot be
    read becomes a notice.
    """

    def seen(look: Preview) -> None:
        if look.has_header:
            use(path, None)
        else:
            _open_dialog(path, look, workbench, parent, use)

    workbench.work(
        "preview",
        translate("shell", "Inspecting {name} …").format(name=path.name),
        lambda: preview(path),
        seen,
    )


def _open_dialog(
    path: Path,
    look: Preview,
    workbench: Workbench,
    parent: QWidget,
    use: Callable[[Path, str | None], None],
) -> None:
    key = f"columns.{look.fingerprint}"
    dialog = ColumnMappingDialog(path, look, workbench.robot, parent)
    dialog.set_columns(workbench.settings.get(key, ""))

    def accept() -> None:
        workbench.settings.set(key, dialog.columns)
        use(path, dialog.columns)

    dialog.accepted.connect(accept)
    dialog.show()


class ColumnMappingDialog(QDialog):
    """The file's first rows with a choice over each column: what it is, and in which unit."""

    def __init__(self, path: Path, seen: Preview, robot: Robot, parent: QWidget) -> None:
        super().__init__(parent)
        self.setWindowTitle(translate("shell", "Columns of {name}").format(name=path.name))
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._robot = robot
        self._choices = [_choice(robot) for _ in range(seen.column_count)]
        self._choices[0].setCurrentText("t [s]")
        self._complaint = QLabel()
        self._complaint.setProperty("bad", True)
        self._complaint.setWordWrap(True)
        self._buttons = QDialogButtonBox(
            QDialogButtonBox.StandardButton.Ok | QDialogButtonBox.StandardButton.Cancel
        )
        self._buttons.accepted.connect(self.accept)
        self._buttons.rejected.connect(self.reject)
        column = QVBoxLayout(self)
        column.addWidget(
            QLabel(translate("shell", "The file has no header. Choose the content of each column:"))
        )
        column.addWidget(self._table(seen), 1)
        column.addWidget(self._complaint)
        column.addWidget(self._buttons)
        for choice in self._choices:
            choice.editTextChanged.connect(self._check)
        self.resize(min(180 * seen.column_count + 60, 1100), 460)
        self._check()

    @property
    def columns(self) -> str:
        """What was chosen, as ``t [s], x [mm], …``."""
        return ", ".join(choice.currentText().strip() for choice in self._choices)

    def set_columns(self, columns: str) -> None:
        """Offer names again that were given before; ignored where their count differs."""
        names = [name.strip() for name in columns.split(",")]
        if len(names) == len(self._choices):
            for choice, name in zip(self._choices, names, strict=True):
                choice.setCurrentText(name)

    def _table(self, seen: Preview) -> QTableWidget:
        table = QTableWidget(len(seen.rows) + 1, seen.column_count)
        table.setEditTriggers(QTableWidget.EditTrigger.NoEditTriggers)
        table.verticalHeader().hide()
        table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        for column, choice in enumerate(self._choices):
            table.setHorizontalHeaderItem(
                column,
                QTableWidgetItem(translate("shell", "column {number}").format(number=column + 1)),
            )
            table.setCellWidget(0, column, choice)
        for row, fields in enumerate(seen.rows):
            for column, field in enumerate(fields[: seen.column_count]):
                table.setItem(row + 1, column, QTableWidgetItem(field))
        table.resizeRowToContents(0)
        return table

    def _check(self) -> None:
        try:
            parse_columns(self.columns, "columns", self._robot)
        except InputError as error:
            self._complaint.setText(error_text(error))
        else:
            self._complaint.setText("")
        self._buttons.button(QDialogButtonBox.StandardButton.Ok).setEnabled(
            not self._complaint.text()
        )


def _choice(robot: Robot) -> QComboBox:
    choice = QComboBox()
    choice.setEditable(True)
    choice.addItems(TIMES)
    for name, axis in robot.axes.items():
        for unit in units_of(axis.unit or "m"):
            choice.addItem(f"{name} [{unit}]")
        for unit in units_of(axis.unit or "m"):
            choice.addItem(f"{name}.meas [{unit}]")
        if not isinstance(axis, StepperAxis):
            choice.addItem(f"{name}.u [V]")
    choice.setCurrentText("")
    return choice
