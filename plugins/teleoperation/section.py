"""Small parts of the panel: a heading with what stands under it, buttons, choices."""

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QComboBox, QFrame, QLabel, QPushButton, QVBoxLayout, QWidget

from rotemina.app.shell.controls import plain_tip


class Section(QFrame):
    """A heading over a column of widgets."""

    def __init__(self, title: str = "") -> None:
        super().__init__()
        self.setObjectName("section")
        self.column = QVBoxLayout(self)
        self.column.setContentsMargins(0, 4, 0, 8)
        self.column.setSpacing(6)
        if title:
            heading = QLabel(title)
            heading.setProperty("heading", True)
            self.column.addWidget(heading)


class SteadyChoice(QComboBox):
    """A choice that the wheel does not change."""

    def wheelEvent(self, event: QWheelEvent) -> None:  # noqa: N802 (Qt's name)
        """Leave the wheel to what scrolls."""
        event.ignore()


def plain_text(*, quiet: bool = True, lines: int = 0) -> QLabel:
    """Return an empty label that is no markup; with ``lines`` it always has room for so many."""
    text = QLabel()
    text.setTextFormat(Qt.TextFormat.PlainText)
    text.setProperty("quiet", quiet)
    if lines:
        text.setWordWrap(True)
        text.setAlignment(Qt.AlignmentFlag.AlignTop | Qt.AlignmentFlag.AlignLeft)
        keep_lines(text, lines)
    return text


def keep_lines(text: QLabel, lines: int) -> None:
    """Give a label room for so many lines, whatever is in it: what is below must not leap."""
    text.ensurePolished()  # the theme says how large text is
    text.setFixedHeight(lines * text.fontMetrics().lineSpacing() + 2)


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
