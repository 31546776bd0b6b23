"""Bar with the arm button, the main button and the phases. It is always visible."""

import time
from collections.abc import Callable

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QLabel, QPushButton, QSizePolicy, QWidget

from rotemina.app.language import translate_message
from rotemina.app.motion.penetration import (
    RUNNING_PHASES,
    PenetrationPhase,
    PenetrationStatus,
)
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import ChangingButton, enable_unless, name_widget
from rotemina.app.widgets.layout import make_row
from rotemina.app.widgets.style import reserve_width
from rotemina.app.widgets.text import make_plain_label
from rotemina.app.workbench import Level, StateTone, Workbench, set_tone
from rotemina.drivers.contract import Clock
from rotemina.plugins.connection import find_rest_objection
from rotemina.plugins.penetration import tr
from rotemina.plugins.penetration.words import (
    STRIP_PHASES,
    PhaseLight,
    find_arm_text,
    find_arm_tip,
    find_button_objection,
    find_button_text,
    find_button_tip,
    find_lights,
    format_headline,
    is_press_valid,
)

_LIGHT_TONES = {
    PhaseLight.OFF: StateTone.QUIET,
    PhaseLight.PASSED: StateTone.GOOD,
    PhaseLight.PRESENT: StateTone.BUSY,
    PhaseLight.HELD: StateTone.WARNING,
}
_HEADLINE_TONES = {
    PenetrationPhase.DISARMED: StateTone.QUIET,
    PenetrationPhase.ARMED: StateTone.WARNING,
    PenetrationPhase.DONE: StateTone.GOOD,
    PenetrationPhase.ABORTED: StateTone.WARNING,
    PenetrationPhase.FAILED: StateTone.DANGER,
    PenetrationPhase.HELD: StateTone.DANGER,
}


class RunButtons(QWidget):
    """Two buttons whose labels depend on the phase, and a label with the phase.

    Subclasses lay them out. A press does what the label says, or nothing if the phase has changed.
    """

    def __init__(self, workbench: Workbench, clock: Clock) -> None:
        super().__init__()
        self._workbench, self._operation = workbench, workbench.operation
        self._clock, self._last_press_s = clock, float("-inf")
        self._shown_phase = PenetrationPhase.DISARMED
        labels = dict.fromkeys(map(find_arm_text, (self._shown_phase, *PenetrationPhase)))
        self.arm = ChangingButton(*map(tr, labels), run=self._on_arm_pressed)
        self.main_button = QPushButton(tr(find_button_text(self._shown_phase)))
        self.main_button.setProperty("primary", True)
        # Only Tab gives it the focus, so that the space bar cannot press it again after a click.
        self.main_button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        # It acts when it is pressed, because a stop must not wait for the release.
        self.main_button.pressed.connect(self._on_main_pressed)
        self.phase = name_widget(QLabel(), tr("Phase of the penetration"))
        self.phase.setAlignment(Qt.AlignmentFlag.AlignCenter)

    def show_status(
        self,
        status: PenetrationStatus,
        state: SessionState,
        find_arming_objection: Callable[[], str | None],
    ) -> str | None:
        """Show the status. Return why the arm button cannot act, or None if it can.

        ``find_arming_objection`` returns why arming is impossible, or None if it is possible.
        """
        self._shown_phase = phase = status.phase
        objection = None
        if phase in RUNNING_PHASES:
            template = tr("the penetration is running ({phase}); stop it first")
            objection = template.format(phase=translate_message(phase))
        elif find_arm_text(phase) == "Arm":
            objection = find_arming_objection()
        self.arm.show_meaning(tr(find_arm_text(phase)))
        enable_unless(self.arm, objection, tr(find_arm_tip(phase)))
        self.main_button.setText(tr(find_button_text(phase)))
        enable_unless(
            self.main_button, find_button_objection(status, state), tr(find_button_tip(phase))
        )
        self.phase.setText(format_headline(status))
        set_tone(self.phase, _HEADLINE_TONES.get(phase, StateTone.BUSY))
        return objection

    def _ask_to_arm(self) -> None:
        raise NotImplementedError

    def _on_arm_pressed(self) -> None:
        penetration, label = self._operation.penetration, find_arm_text(self._shown_phase)
        if label != find_arm_text(penetration.status.phase):
            # The phase changed just before the press.
            self._report_change()
        elif label == "Arm":
            self._ask_to_arm()
        else:
            self._workbench.run_request(penetration.disarm)

    def _on_main_pressed(self) -> None:
        now_s = self._clock()
        phase, since_s = self._operation.penetration.status.phase, now_s - self._last_press_s
        self._last_press_s = now_s
        if find_button_text(self._shown_phase) != find_button_text(phase):
            self._report_change()
        elif is_press_valid(self._shown_phase, phase, since_s):
            self._workbench.run_request(self._operation.press_penetration)

    def _report_change(self) -> None:
        text = tr(
            "Nothing was done: the penetration entered another phase just before you pressed. "
            "Read the button, then press again."
        )
        self._workbench.notify(Level.WARNING, text, about=self)


class RunBar(RunButtons):
    """Bar with the two buttons and the phases.

    Signals
    -------
    arm_asked() : the operator wants to arm the parameters.
    prepare_asked() : the operator wants to move the nano stage back, to gain travel for them.
    """

    arm_asked = Signal()
    prepare_asked = Signal()

    def __init__(self, workbench: Workbench, clock: Clock = time.monotonic) -> None:
        super().__init__(workbench, clock)
        self.arm.setMinimumWidth(104)
        self.prepare = QPushButton(tr("Prepare"))
        self.prepare.clicked.connect(lambda _: self.prepare_asked.emit())
        self.prepare.hide()
        self.main_button.setObjectName("penetration")
        self.main_button.setMinimumSize(140, 34)
        widest_text = tr("armed, {left_s:.0f} s").format(left_s=600)
        reserve_width(self.phase, widest_text, extra_px=30)
        self.strip = {phase: _make_chip(translate_message(phase)) for phase in STRIP_PHASES}
        parts = self.arm, self.prepare, self.main_button, self.phase
        make_row(*parts, 1, *self.strip.values(), 1, on=self, margins=0, spacing=4)

    def refresh(
        self, status: PenetrationStatus, state: SessionState, arming_objection: str | None
    ) -> None:
        """Show the status. ``arming_objection`` says why arming is impossible, or is None."""
        self.show_status(
            status,
            state,
            lambda: None if arming_objection is None else translate_message(arming_objection),
        )
        for chip, light in zip(self.strip.values(), find_lights(status), strict=True):
            set_tone(chip, _LIGHT_TONES[light])
            chip.setAccessibleDescription(translate_message(light))

    def offer_preparation(self, lacks_room: bool, state: SessionState) -> None:
        """Offer to move the nano stage back if it lacks travel."""
        self.prepare.setVisible(lacks_room)
        enable_unless(
            self.prepare,
            state.lock_reason or find_rest_objection(state),
            tr("Move Z nano back as far as needed; Z compensates, so the tip stays in place"),
        )

    def _ask_to_arm(self) -> None:
        self.arm_asked.emit()


def _make_chip(text: str) -> QLabel:
    chip = make_plain_label(text, quiet=False)
    # Six chips share one row. A narrow dock cuts them off, but the phase on their left stays
    # readable.
    chip.setStyleSheet("padding: 1px 3px;")
    chip.setMinimumWidth(16)
    chip.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)
    return chip
