"""The state of the session: its phase, locks, and the emergency stop."""

from PySide6.QtWidgets import QLabel

from rotemina.app.motion.state import SessionState
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.language import translate
from rotemina.app.shell.phase_words import PhaseLabel
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import allow, button
from rotemina.app.widgets.layouts import in_row
from rotemina.app.widgets.section import Section
from rotemina.plugins.connection import unavailable_reasons


class StateSection(Section):
    """The phase in one word, and the reason why motion is locked."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(translate("connection", "State"))
        self.phase = PhaseLabel()
        self.device = QLabel()
        self.device.setProperty("quiet", True)
        self.column.addLayout(in_row(self.phase, (self.device, 1), spacing=8))
        self.reason = self.add_text()
        self.emergency = button(translate("connection", "Stop and lock"), workbench.emergency_stop)
        self.release = button(translate("connection", "Release"), workbench.release)
        self.clear = button(translate("connection", "Clear fault"), workbench.clear_fault)
        self.add_row(self.emergency, self.release, self.clear)
        self._session = workbench.session

    def refresh(self, state: SessionState) -> None:
        """Show a state."""
        self.phase.show_state(state)
        self.device.setText(self._session.driver.name)
        locked = state.locked
        self.reason.setText(
            translate("connection", "Motion is possible.")
            if locked is None
            else translate("connection", "Locked: {locked}.").format(locked=spoken(locked))
        )
        latched = (
            translate("connection", "{latched} is already locked").format(
                latched=spoken(state.latched)
            )
            if state.latched is not None
            else None
        )
        allow(
            self.emergency,
            latched,
            translate("connection", "Stop all axes and block motion until release"),
        )
        allow(
            self.release,
            None if state.latched is not None else translate("connection", "nothing is locked"),
            translate(
                "connection", "Release the lock; the machine stays at rest until the next command"
            ),
        )
        allow(
            self.clear,
            unavailable_reasons.against_clearing(state),
            translate("connection", "Acknowledge the device's fault"),
        )
