"""Positions of the axes: homing, the way back, and owners."""

from PySide6.QtWidgets import QHBoxLayout, QPushButton

from rotemina.app.display_units import label
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.state_words import describe_motion
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import allow, button
from rotemina.app.widgets.section import Section
from rotemina.drivers.abilities import Homer
from rotemina.plugins.connection import tr, unavailable_reasons


class PositionSection(Section):
    """Homing of all axes or of one, and taking back a move."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Position"))
        self._workbench = workbench
        self.text = self.add_text()
        self.home_all = button(tr("Home all"), workbench.home)
        self.home: dict[str, QPushButton] = {}
        self._axes: QHBoxLayout = self.add_row(self.home_all)
        self.back = button(tr("Back"), workbench.undo)
        self.add_row(self.back)
        self.owners = self.add_text()

    def refresh(self, state: SessionState) -> None:
        """Show a state."""
        driver = self._workbench.session.driver
        self._offer(driver.homing_axes if isinstance(driver, Homer) else ())
        self.text.setText(_known(state))
        why = unavailable_reasons.against_homing(state, driver)
        allow(self.home_all, why, tr("Find the limit switches of all axes with switches"))
        for axis, one in self.home.items():
            allow(one, why, tr("Find the limit switch of {label}").format(label=label(axis)))
        allow(
            self.back,
            unavailable_reasons.against_going_back(
                state, undoable=self._workbench.session.undoable
            ),
            tr("Return to the position before the latest move: up, across, down"),
        )
        self.owners.setText(describe_motion(state))

    def _offer(self, axes: tuple[str, ...]) -> None:
        """Have a button for each axis that has a switch."""
        if tuple(self.home) == axes:
            return
        for old in self.home.values():
            self._axes.removeWidget(old)
            old.hide()
            old.deleteLater()
        self.home = {axis: self._button(axis) for axis in axes}
        for one in self.home.values():
            self._axes.addWidget(one)

    def _button(self, axis: str) -> QPushButton:
        made = button(label(axis), lambda: self._workbench.home((axis,)))
        made.setAccessibleName(tr("Home {label}").format(label=label(axis)))
        return made


def _known(state: SessionState) -> str:
    if state.unhomed:
        return tr("Not homed: {axes}").format(axes=", ".join(label(axis) for axis in state.unhomed))
    return tr("All positions are known.") if state.position_known else tr("No position is known.")
