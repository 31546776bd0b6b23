"""Section with the state of the session: its phase, the reason for a lock, and its buttons."""

from rotemina.app.language import translate_message
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import enable_unless, make_button
from rotemina.app.widgets.layout import Section, make_row
from rotemina.app.widgets.text import make_plain_label
from rotemina.app.workbench import PhaseLabel, Workbench
from rotemina.plugins.connection import tr, unavailable_reasons


class StateSection(Section):
    """Section with the phase in one word, the reason for a lock, and the lock buttons."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("State"))
        self.phase = PhaseLabel()
        self.device = make_plain_label()
        self.column.addLayout(make_row(self.phase, (self.device, 1), spacing=8))
        self.reason = self.add_text()
        self.emergency = make_button(tr("Stop and lock"), workbench.emergency_stop)
        self.release = make_button(tr("Release"), workbench.release)
        self.clear = make_button(tr("Clear fault"), workbench.clear_fault)
        self.confirm = make_button(tr("Confirm position"), workbench.confirm_position)
        self.add_row(self.emergency, self.release)
        self.add_row(self.clear, self.confirm)
        self._workbench, self._session = workbench, workbench.session

    def refresh(self, state: SessionState) -> None:
        """Show the state of the session."""
        display = self._workbench.describe(state)
        self.phase.show_phase(display.headword, display.tone)
        self.device.setText(self._session.driver.name)
        lock_reason = state.lock_reason
        self.reason.setText(
            tr("Motion is possible.")
            if lock_reason is None
            else tr("Locked: {locked}.").format(locked=translate_message(lock_reason))
        )
        stop_objection = (
            tr("{latched} is already locked").format(latched=translate_message(state.latch_reason))
            if state.latch_reason is not None
            else None
        )
        enable_unless(
            self.emergency, stop_objection, tr("Stop all axes and block motion until release")
        )
        enable_unless(
            self.release,
            None if state.latch_reason is not None else tr("nothing is locked"),
            tr("Release the lock; the machine stays at rest until the next command"),
        )
        enable_unless(
            self.clear,
            unavailable_reasons.find_clear_objection(state),
            tr("Acknowledge the device's fault"),
        )
        enable_unless(
            self.confirm,
            unavailable_reasons.find_confirm_objection(state),
            tr("Confirm that the machine has not moved since the connection was lost"),
        )
