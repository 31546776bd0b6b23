"""Section with buttons for homing and for the return to the previous position.

It also shows who moves which axis.
"""

from PySide6.QtWidgets import QHBoxLayout, QPushButton

from rotemina.app.language import get_axis_label
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import enable_unless, make_button
from rotemina.app.widgets.layout import Section
from rotemina.app.workbench import Workbench, describe_motion
from rotemina.drivers.abilities import AxisHomer
from rotemina.plugins.connection import tr, unavailable_reasons


class HomingSection(Section):
    """Section that homes all axes or one axis, and undoes the latest move."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Position"))
        self._workbench = workbench
        self.text = self.add_text()
        self.home_all = make_button(tr("Home all"), workbench.home)
        self.home_buttons: dict[str, QPushButton] = {}
        self._button_row: QHBoxLayout = self.add_row(self.home_all)
        self.back = make_button(tr("Back"), workbench.undo)
        self.add_row(self.back)
        self.owners = self.add_text()

    def refresh(self, state: SessionState) -> None:
        """Show the state of the session."""
        driver = self._workbench.session.driver
        self._show_home_buttons(driver.homing_axes if isinstance(driver, AxisHomer) else ())
        self.text.setText(_describe_homing(state))
        homing_objection = unavailable_reasons.find_homing_objection(state, driver)
        enable_unless(
            self.home_all, homing_objection, tr("Find the limit switches of all axes with switches")
        )
        for axis, home_button in self.home_buttons.items():
            enable_unless(
                home_button,
                homing_objection,
                tr("Find the limit switch of {label}").format(label=get_axis_label(axis)),
            )
        enable_unless(
            self.back,
            unavailable_reasons.find_undo_objection(
                state, undoable=self._workbench.session.can_undo
            ),
            tr("Return to the position before the latest move: up, across, down"),
        )
        self.owners.setText(describe_motion(state))

    def _show_home_buttons(self, axes: tuple[str, ...]) -> None:
        if tuple(self.home_buttons) == axes:
            return
        for old_button in self.home_buttons.values():
            self._button_row.removeWidget(old_button)
            old_button.hide()
            old_button.deleteLater()
        self.home_buttons = {axis: self._make_home_button(axis) for axis in axes}
        for home_button in self.home_buttons.values():
            self._button_row.addWidget(home_button)

    def _make_home_button(self, axis: str) -> QPushButton:
        home_button = make_button(get_axis_label(axis), lambda: self._workbench.home((axis,)))
        home_button.setAccessibleName(tr("Home {label}").format(label=get_axis_label(axis)))
        return home_button


def _describe_homing(state: SessionState) -> str:
    if state.unhomed:
        return tr("Not homed: {axes}").format(
            axes=", ".join(get_axis_label(axis) for axis in state.unhomed)
        )
    return tr("All positions are known.") if state.position_known else tr("No position is known.")
