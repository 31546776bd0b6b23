"""The chip in the header that says who moves the machine."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QSizePolicy

from rotemina.app.motion.state import SessionState
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.language import translate
from rotemina.app.shell.phase_words import Tone, driven, set_tone
from rotemina.app.widgets.controls import plain_tip


class OwnerChip(QLabel):
    """Who drives axes now: operator, joystick, playback, penetration …; quiet while nobody does."""

    def __init__(self) -> None:
        super().__init__()
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.setAccessibleName(translate("shell", "Who moves the machine"))
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self._told = ""
        self._show("", "")

    def refresh(self, state: SessionState) -> None:
        """Show who drives."""
        owners = " + ".join(dict.fromkeys(map(spoken, state.owners.values())))
        if owners != self._told:
            self._show(owners, driven(state))

    def _show(self, owners: str, axes: str) -> None:
        self._told = owners
        self.setText(owners[:1].upper() + owners[1:] if owners else translate("shell", "Free"))
        set_tone(self, Tone.BUSY if owners else Tone.QUIET)
        self.setToolTip(
            plain_tip(
                translate("shell", "Who moves the machine: each moving axis has one owner"),
                axes or translate("shell", "Nobody at present."),
            )
        )
