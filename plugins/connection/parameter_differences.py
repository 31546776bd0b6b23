"""Section with the parameters that differ between the device and the robot file."""

from PySide6.QtWidgets import QHeaderView

from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import enable_unless, make_button
from rotemina.app.widgets.layout import Section
from rotemina.app.widgets.text import TextTable, make_plain_label
from rotemina.app.workbench import Workbench
from rotemina.drivers.abilities import ParameterStore
from rotemina.drivers.contract import Driver
from rotemina.plugins.connection import mark, tr, unavailable_reasons
from rotemina.sim.messages import format_rounded

COLUMN_TITLES = (mark("Parameter"), mark("Device"), mark("Robot file"))
_MAX_VISIBLE_ROWS = 6


class ParameterDifferencesSection(Section):
    """Section with a table of the differences.

    Its buttons write the values of the robot file to the device, or accept those of the device.
    """

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Parameters"))
        self._session = workbench.session
        self._shown_differences: tuple[str, ...] = ()
        self.text = make_plain_label(lines=3)
        self.column.addWidget(self.text)
        self.table = TextTable(
            tr("Parameters that differ"), [tr(name) for name in COLUMN_TITLES], row_height=24
        )
        self.table.horizontalHeader().setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        self.table.setVisible(False)
        self.write = make_button(tr("Write to device"), workbench.write_parameters)
        self.accept = make_button(tr("Accept"), workbench.accept_parameters)
        self.add_row(self.write, self.accept)
        # The table is last, so that no button moves when it appears.
        self.column.addWidget(self.table)

    def refresh(self, state: SessionState) -> None:
        """Show the differences in this state."""
        driver = self._session.driver
        if state.differences != self._shown_differences:
            self._shown_differences = state.differences
            self._fill_table(_make_rows(driver, state.differences))
        objection = unavailable_reasons.find_write_objection(state, driver)
        count = len(state.differences)
        if count:
            subject = (
                tr("One parameter differs")
                if count == 1
                else tr("{count} parameters differ").format(count=count)
            )
            self.text.setText(
                tr(
                    "{are} from the robot file; the machine cannot move until you write or "
                    "accept the values."
                ).format(are=subject)
            )
        else:
            stores_parameters = isinstance(driver, ParameterStore)
            no_parameters_text = tr("{name} stores no parameters.").format(name=driver.name)
            self.text.setText(
                tr("The parameters match the robot file.")
                if stores_parameters
                else no_parameters_text
            )
        enable_unless(self.write, objection, tr("Store the values of the robot file in the device"))
        enable_unless(
            self.accept, objection, tr("Use the values of the device until the next connection")
        )

    def _fill_table(self, rows: list[tuple[str, ...]]) -> None:
        self.table.show_rows(rows, tips=True)
        self.table.setVisible(bool(rows))
        self.table.setFixedHeight(28 + 24 * min(len(rows), _MAX_VISIBLE_ROWS))


def _make_rows(driver: Driver, difference_texts: tuple[str, ...]) -> list[tuple[str, ...]]:
    """Return the name, device value and robot-file value of each difference.

    If the driver no longer reports a difference, its row contains only the text.
    """
    reported_differences = (
        {str(difference): difference for difference in driver.differences}
        if isinstance(driver, ParameterStore)
        else {}
    )
    rows: list[tuple[str, ...]] = []
    for text in difference_texts:
        difference = reported_differences.get(text)
        rows.append(
            (text, "", "")
            if difference is None
            else (
                difference.name,
                f"{format_rounded(difference.device, 6)} {difference.unit}",
                f"{format_rounded(difference.robot, 6)} {difference.unit}",
            )
        )
    return rows
