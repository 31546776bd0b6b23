"""The state of the session: its phase, what locks motion, and what ends that."""

from rotemina.app.motion.state import SessionState
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.state_tone import PhaseLabel
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import allow, button
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_row
from rotemina.app.widgets.section import Section
from rotemina.plugins.connection import tr, unavailable_reasons


class StateSection(Section):
    """The phase in one word, and the reason why motion is locked."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("State"))
        self.phase = PhaseLabel()
        self.device = plain_text()
        self.column.addLayout(in_row(self.phase, (self.device, 1), spacing=8))
        self.reason = self.add_text()
        self.emergency = button(tr("Stop and lock"), workbench.emergency_stop)
        self.release = button(tr("Release"), workbench.release)
        self.clear = button(tr("Clear fault"), workbench.clear_fault)
        self.confirm = button(tr("Confirm position"), workbench.confirm_position)
        self.add_row(self.emergency, self.release)
        self.add_row(self.clear, self.confirm)
        self._workbench, self._session = workbench, workbench.session

    def refresh(self, state: SessionState) -> None:
        """Show a state."""
        display = self._workbench.describe(state)
        self.phase.show_word(display.headword, display.tone)
        self.device.setText(self._session.driver.name)
        locked = state.locked
        self.reason.setText(
            tr("Motion is possible.")
            if locked is None
            else tr("Locked: {locked}.").format(locked=spoken(locked))
        )
        latched = (
            tr("{latched} is already locked").format(latched=spoken(state.latched))
            if state.latched is not None
            else None
        )
        allow(self.emergency, latched, tr("Stop all axes and block motion until release"))
        allow(
            self.release,
            None if state.latched is not None else tr("nothing is locked"),
            tr("Release the lock; the machine stays at rest until the next command"),
        )
        allow(
            self.clear,
            unavailable_reasons.against_clearing(state),
            tr("Acknowledge the device's fault"),
        )
        allow(
            self.confirm,
            unavailable_reasons.against_confirming(state),
            tr("Confirm that the machine has not moved since the connection was lost"),
        )
