"""How grave the words of a state are, and labels in the colour of that."""

from enum import StrEnum

from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.shell.language import translate
from rotemina.app.widgets.controls import set_property
from rotemina.app.widgets.labels import LiveLabel


class Tone(StrEnum):
    """How grave a word is; the style sheet has a colour for each."""

    GOOD = "good"
    BUSY = "busy"
    WARNING = "warning"
    DANGER = "danger"
    QUIET = "quiet"


def set_tone(widget: QWidget, value: Tone) -> None:
    """Give a widget the colours of a tone."""
    set_property(widget, "tone", str(value))


class PhaseLabel(LiveLabel):
    """The state in a word or two, in its colour."""

    def __init__(self) -> None:
        super().__init__("–")
        self.setAccessibleName(translate("shell", "Phase of the session"))
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        set_tone(self, Tone.QUIET)

    def show_word(self, word: str, tone: Tone) -> None:
        """Show a word in the colour of its tone."""
        self.setText(word)
        set_tone(self, tone)
