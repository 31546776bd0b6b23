"""Overview: the device in control, whether it is active, and why nothing moves."""

from PySide6.QtWidgets import QSizePolicy

from rotemina.app.language import translate_message
from rotemina.app.motion.inputs import InputDisplayState
from rotemina.app.motion.teleoperation import TeleoperationState
from rotemina.app.widgets.controls import (
    make_tooltip,
    name_widget,
    set_property,
)
from rotemina.app.widgets.layout import Section, make_row
from rotemina.app.widgets.text import ElidedLabel, make_plain_label
from rotemina.app.workbench import StateTone, set_tone
from rotemina.plugins.teleoperation import tr, wording


class OverviewSection(Section):
    """Section with the state in one word, and three lines of details.

    Its height is constant, so that the widgets below do not move.
    """

    def __init__(self) -> None:
        super().__init__()
        self.state_label = name_widget(
            make_plain_label("–", quiet=False), tr("State of teleoperation")
        )
        self.state_label.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        set_tone(self.state_label, StateTone.QUIET)
        self.device, self.trust, self.refusal_label = ElidedLabel(), ElidedLabel(), ElidedLabel()
        self.device.setProperty("heading", True)
        self.device.setAccessibleName(tr("Device in control"))
        self.trust.setProperty("quiet", True)
        self.trust.setAccessibleName(tr("Whether the stick is active"))
        self.refusal_label.setAccessibleName(tr("Latest refusal or slowdown"))
        self.reason = name_widget(make_plain_label(lines=2), tr("Reason for no motion"))
        row = make_row(self.state_label, (self.device, 1), spacing=8)
        self.column.setSpacing(3)
        self.column.addLayout(row)
        self.column.addWidget(self.trust)
        self.column.addWidget(self.reason)
        self.column.addWidget(self.refusal_label)

    def refresh(self, view: InputDisplayState, state: TeleoperationState, *, stale: bool) -> None:
        """Show the current state."""
        word, tone = wording.describe_state(view, state, stale=stale)
        self.state_label.setText(word)
        set_tone(self.state_label, tone)
        self.device.show_text(wording.name_driving_devices(view))
        self.trust.show_text(wording.describe_trust(view))
        set_property(self.device, "stale", stale)
        reason = wording.explain_no_motion(state, stale=stale)
        if reason != self.reason.text():
            self.reason.setText(reason)
            self.reason.setToolTip(make_tooltip(reason) if reason else "")
        self.refusal_label.show_text(
            tr("Last: {refused}").format(refused=translate_message(state.refusal_reason))
            if state.refusal_reason
            else ""
        )
        set_property(self.refusal_label, "bad", state.refusal_reason is not None)
