"""Where the device's parameters differ from the robot file: write them, or accept."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableWidget, QTableWidgetItem

from rotemina.app.motion.state import SessionState
from rotemina.app.shell.controls import allow, plain_tip
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.workbench import Workbench
from rotemina.drivers.abilities import Parameterised
from rotemina.drivers.driver import Driver
from rotemina.plugins.connection import reasons
from rotemina.plugins.connection.section import Section, button

COLUMNS = (
    marked("connection", "Parameter"),
    marked("connection", "Device"),
    marked("connection", "Robot file"),
)
_MOST_ROWS_SHOWN = 6


class ParameterSection(Section):
    """A table of what differs, and the two ways to settle it."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(translate("connection", "Parameters"))
        self._session = workbench.session
        self._shown: tuple[str, ...] = ()
        self.text = self.add_text()
        self.table = QTableWidget(0, len(COLUMNS))
        self.table.setAccessibleName(translate("connection", "Parameters that differ"))
        self.table.setHorizontalHeaderLabels([translate("connection", name) for name in COLUMNS])
        self.table.verticalHeader().hide()
        self.table.verticalHeader().setDefaultSectionSize(24)
        self.table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.table.setTabKeyNavigation(False)
        self.table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        self.table.horizontalHeader().setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        self.table.setVisible(False)
        self.column.addWidget(self.table)
        self.write = button(translate("connection", "Write to device"), workbench.write_parameters)
        self.accept = button(translate("connection", "Accept"), workbench.accept_parameters)
        self.add_row(self.write, self.accept)

    def refresh(self, state: SessionState) -> None:
        """Show a state."""
        driver = self._session.driver
        if state.differences != self._shown:
            self._shown = state.differences
            self._fill(_rows(driver, state.differences))
        why = reasons.against_writing(state, driver)
        count = len(state.differences)
        if count:
            are = (
                translate("connection", "One parameter differs")
                if count == 1
                else translate("connection", "{count} parameters differ").format(count=count)
            )
            self.text.setText(
                translate(
                    "connection", "{are} from the robot file; nothing moves until that is settled."
                ).format(are=are)
            )
        else:
            keeps = isinstance(driver, Parameterised)
            none = translate("connection", "{name} keeps no parameters of its own.").format(
                name=driver.name
            )
            self.text.setText(
                translate("connection", "Nothing differs from the robot file.") if keeps else none
            )
        allow(
            self.write,
            why,
            translate(
                "connection", "Write the robot file's values into the device, which keeps them"
            ),
        )
        allow(
            self.accept,
            why,
            translate("connection", "Move with the device's own values until it is opened again"),
        )

    def _fill(self, rows: list[tuple[str, ...]]) -> None:
        self.table.setRowCount(len(rows))
        for row, texts in enumerate(rows):
            for column, text in enumerate(texts):
                item = QTableWidgetItem(text)
                item.setToolTip(plain_tip(text))
                if column:
                    item.setTextAlignment(
                        Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
                    )
                self.table.setItem(row, column, item)
        self.table.setVisible(bool(rows))
        self.table.setFixedHeight(28 + 24 * min(len(rows), _MOST_ROWS_SHOWN))


def _rows(driver: Driver, told: tuple[str, ...]) -> list[tuple[str, ...]]:
    """Return name, device and robot file of what was told, as far as the driver still says so."""
    known = (
        {str(one): one for one in driver.differences} if isinstance(driver, Parameterised) else {}
    )
    rows: list[tuple[str, ...]] = []
    for text in told:
        one = known.get(text)
        rows.append(
            (text, "", "")
            if one is None
            else (one.name, f"{one.device:g} {one.unit}", f"{one.robot:g} {one.unit}")
        )
    return rows
