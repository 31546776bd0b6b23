"""The two buttons of the penetration, as in its own panel, and its progress."""

import time

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QPushButton, QSizePolicy, QWidget

from rotemina.app.motion.penetration.status import UNDER_WAY, Phase
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.language import translate
from rotemina.app.shell.phase_words import Tone, set_tone
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import allow, plain_tip
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.drivers.clock import Clock
from rotemina.plugins.control import tr
from rotemina.plugins.penetration.plan_preview import PlanPreview
from rotemina.plugins.penetration.words import (
    against_button,
    arm_tip,
    arm_word,
    button_tip,
    button_word,
    counts,
    headline,
    message,
)

_TONES = {
    Phase.DISARMED: Tone.QUIET,
    Phase.ARMED: Tone.WARNING,
    Phase.DONE: Tone.GOOD,
    Phase.ABORTED: Tone.WARNING,
    Phase.FAILED: Tone.DANGER,
    Phase.HELD: Tone.DANGER,
}


class PenetrationPage(QWidget):
    """Arm with the parameters that the Penetration panel holds; start, stop, retract."""

    def __init__(self, workbench: Workbench, clock: Clock = time.monotonic) -> None:
        super().__init__()
        self._workbench, self._operation = workbench, workbench.operation
        self._clock, self._pressed_s = clock, float("-inf")
        self._shown = Phase.DISARMED
        self._plan_preview: PlanPreview | None = None
        self._planned_for: object = None
        self.arm = QPushButton(translate("penetration", arm_word(self._shown)))
        self.arm.setToolTip(tr("Prepare the penetration without motion"))
        self.arm.clicked.connect(lambda _: self._arm())
        self.button = QPushButton(translate("penetration", button_word(self._shown)))
        self.button.setToolTip(tr("Start the armed penetration"))
        self.button.setProperty("primary", True)
        # By Tab alone: no space bar that follows a click may start or end anything.
        self.button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        # On pressing, not on release: what stops must not wait for the finger to lift.
        self.button.pressed.connect(self._press)
        self.phase = QLabel()
        self.phase.setAccessibleName(tr("Phase of the penetration"))
        self.phase.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.message = plain_text(lines=3)
        self.parameters = plain_text()
        self.phase.setMinimumSize(130, 22)
        self.phase.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        row = in_row((self.arm, 1), (self.button, 2), spacing=6)
        parts = row, self.phase, self.message, self.parameters, 1
        in_column(*parts, on=self, margins=(10, 6, 10, 4), spacing=4)

    def refresh(self, state: SessionState) -> None:
        """Show a moment, and lock what cannot be done now."""
        status = self._operation.penetration.status
        self._shown = phase = status.phase
        self.arm.setText(translate("penetration", arm_word(phase)))
        against = (
            tr("the penetration is running ({phase}); stop it first").format(phase=spoken(phase))
            if phase in UNDER_WAY
            else None
        )
        if arm_word(phase) == "Arm" and against is None:
            against = self._against_arming(state)
        allow(self.arm, against, translate("penetration", arm_tip(phase)))
        self.button.setText(translate("penetration", button_word(phase)))
        allow(
            self.button, against_button(status, state), translate("penetration", button_tip(phase))
        )
        self.phase.setText(headline(status))
        set_tone(self.phase, _TONES.get(phase, Tone.BUSY))
        told = message(status, against)
        if told != self.message.text():
            self.message.setText(told)
            self.message.setToolTip(plain_tip(told))
        axis = self._operation.penetration_parameters.axis
        told = tr("Axis {axis}; parameters: see the Penetration panel.").format(axis=axis)
        if told != self.parameters.text():
            self.parameters.setText(told)

    def _against_arming(self, state: SessionState) -> str | None:
        session, parameters = self._workbench.session, self._operation.penetration_parameters
        if self._plan_preview is None or self._planned_for != (parameters, session.driver):
            self._planned_for = (parameters, session.driver)
            self._plan_preview = PlanPreview.of(session, parameters)
        if self._plan_preview.plan is None:
            return self._plan_preview.problem
        if state.locked is not None:
            return tr("motion is locked: {locked}").format(locked=spoken(state.locked))
        return self._operation.penetration.why_not(parameters, self._plan_preview.plan)

    def _arm(self) -> None:
        operation, word = self._operation, arm_word(self._shown)
        if word != arm_word(operation.penetration.status.phase):
            return  # it acts as it was labelled, or not at all
        if word == "Arm":
            parameters = operation.penetration_parameters
            self._workbench.ask(lambda: operation.arm_penetration(parameters))
        else:
            self._workbench.ask(operation.penetration.disarm)

    def _press(self) -> None:
        now_s = self._clock()
        phase, since_s = self._operation.penetration.status.phase, now_s - self._pressed_s
        self._pressed_s = now_s
        if counts(self._shown, phase, since_s):
            self._workbench.ask(self._operation.press_penetration)
