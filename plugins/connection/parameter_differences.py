"""Differences between device parameters and robot file: write or accept them."""

from PySide6.QtWidgets import QHeaderView

from rotemina.app.motion.state import SessionState
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import allow, button
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.section import Section
from rotemina.app.widgets.table import Table
from rotemina.drivers.abilities import Parameterised
from rotemina.drivers.driver import Driver
from rotemina.plugins.connection import mark, tr, unavailable_reasons
from rotemina.sim.quantities import rounded

COLUMNS = (mark("Parameter"), mark("Device"), mark("Robot file"))
_MOST_ROWS_SHOWN = 6


class ParameterSection(Section):
    """A table of the differences, and the two ways to settle them."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Parameters"))
        self._session = workbench.session
        self._shown: tuple[str, ...] = ()
        self.text = plain_text(lines=3)
        self.column.addWidget(self.text)
        self.table = Table(
            tr("Parameters that differ"), [tr(name) for name in COLUMNS], row_height=24
        )
        self.table.horizontalHeader().setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        self.table.setVisible(False)
        self.write = button(tr("Write to device"), workbench.write_parameters)
        self.accept = button(tr("Accept"), workbench.accept_parameters)
        self.add_row(self.write, self.accept)
        self.column.addWidget(self.table)  # last: no button moves when it appears

    def refresh(self, state: SessionState) -> None:
        """Show a state."""
        driver = self._session.driver
        if state.differences != self._shown:
            self._shown = state.differences
            self._fill(_rows(driver, state.differences))
        why = unavailable_reasons.against_writing(state, driver)
        count = len(state.differences)
        if count:
            are = (
                tr("One parameter differs")
                if count == 1
                else tr("{count} parameters differ").format(count=count)
            )
            self.text.setText(
                tr(
                    "{are} from the robot file; the machine cannot move until you write or "
                    "accept the values."
                ).format(are=are)
            )
        else:
            keeps = isinstance(driver, Parameterised)
            none = tr("{name} stores no parameters.").format(name=driver.name)
            self.text.setText(tr("The parameters match the robot file.") if keeps else none)
        allow(self.write, why, tr("Store the values of the robot file in the device"))
        allow(self.accept, why, tr("Use the values of the device until the next connection"))

    def _fill(self, rows: list[tuple[str, ...]]) -> None:
        self.table.show_rows(rows, tips=True)
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
            else (
                one.name,
                f"{rounded(one.device, 6)} {one.unit}",
                f"{rounded(one.robot, 6)} {one.unit}",
            )
        )
    return rows
