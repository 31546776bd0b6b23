"""Arm, the main button, and the strip of phases, always visible."""

import time
from collections.abc import Callable

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QLabel, QPushButton, QSizePolicy, QWidget

from rotemina.app.motion.penetration.status import UNDER_WAY, PenetrationStatus, Phase
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.state_tone import Tone, set_tone
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.changing_button import ChangingButton
from rotemina.app.widgets.controls import allow, named
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_row
from rotemina.app.widgets.when_dressed import leave_room
from rotemina.drivers.clock import Clock
from rotemina.plugins.connection.unavailable_reasons import in_motion
from rotemina.plugins.penetration import tr
from rotemina.plugins.penetration.words import (
    STRIP,
    Light,
    against_button,
    arm_tip,
    arm_word,
    button_tip,
    button_word,
    counts,
    headline,
    lights,
)

_TONES = {
    Light.OFF: Tone.QUIET,
    Light.PASSED: Tone.GOOD,
    Light.PRESENT: Tone.BUSY,
    Light.HELD: Tone.WARNING,
}
_HEADLINES = {
    Phase.DISARMED: Tone.QUIET,
    Phase.ARMED: Tone.WARNING,
    Phase.DONE: Tone.GOOD,
    Phase.ABORTED: Tone.WARNING,
    Phase.FAILED: Tone.DANGER,
    Phase.HELD: Tone.DANGER,
}


class RunButtons(QWidget):
    """Two buttons whose words follow the phase, and the phase; subclasses lay them out.

    They act as they were labelled when they were pressed, or not at all.
    """

    def __init__(self, workbench: Workbench, clock: Clock) -> None:
        super().__init__()
        self._workbench, self._operation = workbench, workbench.operation
        self._clock, self._pressed_s = clock, float("-inf")
        self._shown = Phase.DISARMED
        words = dict.fromkeys(map(arm_word, (self._shown, *Phase)))
        self.arm = ChangingButton(*map(tr, words), run=self._arm)
        self.button = QPushButton(tr(button_word(self._shown)))
        self.button.setProperty("primary", True)
        # By Tab alone: no space bar that follows a click may start or end anything.
        self.button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        # On pressing, not on release: what stops must not wait for the finger to lift.
        self.button.pressed.connect(self._press)
        self.phase = named(QLabel(), tr("Phase of the penetration"))
        self.phase.setAlignment(Qt.AlignmentFlag.AlignCenter)

    def show_status(
        self, status: PenetrationStatus, state: SessionState, why_not: Callable[[], str | None]
    ) -> str | None:
        """Show a moment; return why the first button cannot act: ``why_not`` says it of arming."""
        self._shown = phase = status.phase
        against = None
        if phase in UNDER_WAY:
            running = tr("the penetration is running ({phase}); stop it first")
            against = running.format(phase=spoken(phase))
        elif arm_word(phase) == "Arm":
            against = why_not()
        self.arm.show_meaning(tr(arm_word(phase)))
        allow(self.arm, against, tr(arm_tip(phase)))
        self.button.setText(tr(button_word(phase)))
        allow(self.button, against_button(status, state), tr(button_tip(phase)))
        self.phase.setText(headline(status))
        set_tone(self.phase, _HEADLINES.get(phase, Tone.BUSY))
        return against

    def _ask_to_arm(self) -> None:
        raise NotImplementedError

    def _arm(self) -> None:
        penetration, word = self._operation.penetration, arm_word(self._shown)
        if word != arm_word(penetration.status.phase):
            self._report_change()  # it acts as it was labelled, or not at all
        elif word == "Arm":
            self._ask_to_arm()
        else:
            self._workbench.ask(penetration.disarm)

    def _press(self) -> None:
        now_s = self._clock()
        phase, since_s = self._operation.penetration.status.phase, now_s - self._pressed_s
        self._pressed_s = now_s
        if button_word(self._shown) != button_word(phase):
            self._report_change()
        elif counts(self._shown, phase, since_s):
            self._workbench.ask(self._operation.press_penetration)

    def _report_change(self) -> None:
        text = tr(
            "Nothing was done: the penetration went on just before the press. Read the button, "
            "then press again."
        )
        self._workbench.notify(Level.WARNING, text, about=self)


class RunBar(RunButtons):
    """The buttons beside the strip of phases.

    Signals
    -------
    arm_asked() : the parameters are to be armed.
    prepare_asked() : the nano stage is to be moved back for them.
    """

    arm_asked = Signal()
    prepare_asked = Signal()

    def __init__(self, workbench: Workbench, clock: Clock = time.monotonic) -> None:
        super().__init__(workbench, clock)
        self.arm.setMinimumWidth(104)
        self.prepare = QPushButton(tr("Prepare"))
        self.prepare.clicked.connect(lambda _: self.prepare_asked.emit())
        self.prepare.hide()
        self.button.setObjectName("penetration")
        self.button.setMinimumSize(140, 34)
        widest = tr("armed, {left_s:.0f} s").format(left_s=600)
        leave_room(self.phase, widest, beside=30)
        self.strip = {one: _chip(spoken(one)) for one in STRIP}
        parts = self.arm, self.prepare, self.button, self.phase
        in_row(*parts, 1, *self.strip.values(), 1, on=self, margins=0, spacing=4)

    def refresh(self, status: PenetrationStatus, state: SessionState, why_not: str | None) -> None:
        """Show a moment; ``why_not`` is why it cannot be armed now."""
        self.show_status(status, state, lambda: None if why_not is None else spoken(why_not))
        for chip, light in zip(self.strip.values(), lights(status), strict=True):
            set_tone(chip, _TONES[light])
            chip.setAccessibleDescription(spoken(light))

    def offer_preparing(self, lacks: bool, state: SessionState) -> None:
        """Offer to move the nano stage back where the way ``lacks`` room."""
        self.prepare.setVisible(lacks)
        allow(
            self.prepare,
            state.locked or in_motion(state),
            tr("Move Z nano back as far as needed; Z compensates, so the tip stays in place"),
        )

    def _ask_to_arm(self) -> None:
        self.arm_asked.emit()


def _chip(text: str) -> QLabel:
    chip = plain_text(text, quiet=False)
    chip.setStyleSheet("padding: 1px 3px;")  # six of them in one row
    chip.setMinimumWidth(16)  # in a narrow dock they are cut; the phase stands before them
    chip.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)
    return chip
