"""Small parts of the control menu."""

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent, QWheelEvent
from PySide6.QtWidgets import QComboBox, QLabel, QLineEdit, QPushButton, QWidget

from rotemina.app.shell.controls import plain_tip


class SteadyChoice(QComboBox):
    """A choice that the wheel does not change."""

    def __init__(self, name: str, tip: str) -> None:
        super().__init__()
        self.setAccessibleName(name)
        self.setToolTip(plain_tip(tip))

    def wheelEvent(self, event: QWheelEvent) -> None:  # noqa: N802 (Qt's name)
        """Leave the wheel to what scrolls."""
        event.ignore()


class TargetField(QLineEdit):
    """A field in which a held Enter counts once."""

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802 (Qt's name)
        """Take a key, but no repetition of Enter."""
        enter = event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)
        if not (enter and event.isAutoRepeat()):
            super().keyPressEvent(event)


def text_label(*, lines: int = 0) -> QLabel:
    """Return a quiet label that is no markup; with ``lines`` it always has room for so many."""
    text = QLabel()
    text.setTextFormat(Qt.TextFormat.PlainText)
    text.setProperty("quiet", True)
    if lines:
        text.setWordWrap(True)
        text.setAlignment(Qt.AlignmentFlag.AlignTop | Qt.AlignmentFlag.AlignLeft)
        text.setFixedHeight(lines * text.fontMetrics().lineSpacing() + 2)
    return text


def button(text: str, tip: str, run: Callable[[], object]) -> QPushButton:
    """Return a push button that does something."""
    made = QPushButton(text)
    made.setToolTip(plain_tip(tip))
    made.clicked.connect(lambda _: run())
    return made


def set_property(widget: QWidget, name: str, value: bool) -> None:
    """Give a widget the colours that the style sheet has for a property."""
    if widget.property(name) != value:
        widget.setProperty(name, value)
        widget.style().unpolish(widget)
        widget.style().polish(widget)
