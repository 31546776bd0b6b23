"""The dialog that names the columns of a file without a header; the answer is remembered."""

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

from rotemina.app.language import describe_error, translate
from rotemina.app.workbench import Workbench
from rotemina.sim.errors import InputError
from rotemina.sim.records import FilePreview, parse_columns, read_preview
from rotemina.sim.robot import Robot, StepperAxis
from rotemina.sim.units import units_of

TIME_COLUMNS = ("t [s]", "t [ms]", "t [us]")


def ask_columns(
    path: Path,
    workbench: Workbench,
    parent: QWidget,
    use: Callable[[Path, str | None], None],
    undone: Callable[[], None] = lambda: None,
) -> None:
    """Call ``use`` with a file and, if it has no header, the names of its columns.

    The beginning of the file is read in the background. The dialog suggests the names last given to
    a file of the same structure. A file that cannot be read causes a notice. In this case, and if
    the dialog is cancelled, ``undone`` is called instead of ``use``.
    """

    def show_dialog(file_preview: FilePreview) -> None:
        if file_preview.has_header:
            use(path, None)
        else:
            _open_dialog(path, file_preview, workbench, parent, use, undone)

    workbench.work(
        "preview",
        translate("shell", "Inspecting {name} …").format(name=path.name),
        lambda: read_preview(path),
        show_dialog,
        undone,
    )


def _open_dialog(
    path: Path,
    file_preview: FilePreview,
    workbench: Workbench,
    parent: QWidget,
    use: Callable[[Path, str | None], None],
    undone: Callable[[], None],
) -> None:
    key = f"columns.{file_preview.fingerprint}"
    dialog = ColumnMappingDialog(path, file_preview, workbench.robot, parent)
    dialog.set_columns(workbench.settings.get(key, ""))

    def accept() -> None:
        workbench.settings.set(key, dialog.columns)
        use(path, dialog.columns)

    dialog.accepted.connect(accept)
    dialog.rejected.connect(undone)
    dialog.show()


class ColumnMappingDialog(QDialog):
    """The first rows of a file, with a choice of quantity and unit above each column."""

    def __init__(
        self, path: Path, file_preview: FilePreview, robot: Robot, parent: QWidget
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(translate("shell", "Columns of {name}").format(name=path.name))
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._robot = robot
        self._column_boxes = [_make_column_box(robot) for _ in range(file_preview.column_count)]
        self._column_boxes[0].setCurrentText("t [s]")
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
        column.addWidget(self._make_table(file_preview), 1)
        column.addWidget(self._complaint)
        column.addWidget(self._buttons)
        for column_box in self._column_boxes:
            column_box.editTextChanged.connect(self._check)
        self.resize(min(180 * file_preview.column_count + 60, 1100), 460)
        self._check()

    @property
    def columns(self) -> str:
        """The chosen columns, as ``t [s], x [mm], …``."""
        return ", ".join(column_box.currentText().strip() for column_box in self._column_boxes)

    def set_columns(self, columns: str) -> None:
        """Fill in column names, unless their number differs from that of the columns."""
        names = [name.strip() for name in columns.split(",")]
        if len(names) == len(self._column_boxes):
            for column_box, name in zip(self._column_boxes, names, strict=True):
                column_box.setCurrentText(name)

    def _make_table(self, file_preview: FilePreview) -> QTableWidget:
        table = QTableWidget(len(file_preview.rows) + 1, file_preview.column_count)
        table.setEditTriggers(QTableWidget.EditTrigger.NoEditTriggers)
        table.verticalHeader().hide()
        table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        for column, column_box in enumerate(self._column_boxes):
            table.setHorizontalHeaderItem(
                column,
                QTableWidgetItem(translate("shell", "column {number}").format(number=column + 1)),
            )
            table.setCellWidget(0, column, column_box)
        for row, fields in enumerate(file_preview.rows):
            for column, field in enumerate(fields[: file_preview.column_count]):
                table.setItem(row + 1, column, QTableWidgetItem(field))
        table.resizeRowToContents(0)
        return table

    def _check(self) -> None:
        try:
            parse_columns(self.columns, "columns", self._robot)
        except InputError as error:
            self._complaint.setText(describe_error(error))
        else:
            self._complaint.setText("")
        self._buttons.button(QDialogButtonBox.StandardButton.Ok).setEnabled(
            not self._complaint.text()
        )


def _make_column_box(robot: Robot) -> QComboBox:
    column_box = QComboBox()
    column_box.setEditable(True)
    column_box.addItems(TIME_COLUMNS)
    for name, axis in robot.axes.items():
        for unit in units_of(axis.unit or "m"):
            column_box.addItem(f"{name} [{unit}]")
        for unit in units_of(axis.unit or "m"):
            column_box.addItem(f"{name}.meas [{unit}]")
        if not isinstance(axis, StepperAxis):
            column_box.addItem(f"{name}.u [V]")
    column_box.setCurrentText("")
    return column_box
