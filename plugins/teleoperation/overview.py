"""The device in control, its trust, and reasons for no motion."""

from PySide6.QtWidgets import QSizePolicy

from rotemina.app.motion.teleoperation.input_arbiter import DevicesView
from rotemina.app.motion.teleoperation.teleoperation_state import TeleoperationState
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.state_tone import Tone, set_tone
from rotemina.app.widgets.controls import named, plain_tip, set_property
from rotemina.app.widgets.labels import ElidedLabel, plain_text
from rotemina.app.widgets.layouts import in_row
from rotemina.app.widgets.section import Section
from rotemina.plugins.teleoperation import tr, wording


class OverviewSection(Section):
    """One word and three lines; its height stays, so that nothing below leaps."""

    def __init__(self) -> None:
        super().__init__()
        self.word = named(plain_text("–", quiet=False), tr("State of teleoperation"))
        self.word.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        set_tone(self.word, Tone.QUIET)
        self.device, self.trust, self.refused = ElidedLabel(), ElidedLabel(), ElidedLabel()
        self.device.setProperty("heading", True)
        self.device.setAccessibleName(tr("Device in control"))
        self.trust.setProperty("quiet", True)
        self.trust.setAccessibleName(tr("Whether the stick is active"))
        self.refused.setAccessibleName(tr("Latest refusal or slowdown"))
        self.reason = named(plain_text(lines=2), tr("Reason for no motion"))
        row = in_row(self.word, (self.device, 1), spacing=8)
        self.column.setSpacing(3)
        self.column.addLayout(row)
        self.column.addWidget(self.trust)
        self.column.addWidget(self.reason)
        self.column.addWidget(self.refused)

    def refresh(self, view: DevicesView, state: TeleoperationState, *, stale: bool) -> None:
        """Show a moment."""
        word, tone = wording.standing(view, state, stale=stale)
        self.word.setText(word)
        set_tone(self.word, tone)
        self.device.show_text(wording.driver_text(view))
        self.trust.show_text(wording.trust_text(view))
        set_property(self.device, "stale", stale)
        why = wording.reason_text(state, stale=stale)
        if why != self.reason.text():
            self.reason.setText(why)
            self.reason.setToolTip(plain_tip(why) if why else "")
        self.refused.show_text(
            tr("Last: {refused}").format(refused=spoken(state.refused)) if state.refused else ""
        )
        set_property(self.refused, "bad", state.refused is not None)
