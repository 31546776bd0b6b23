"""Small parts of the panel: a heading with what stands under it, buttons, choices."""

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import (
    QComboBox,
    QFrame,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from rotemina.app.shell.controls import plain_tip


class Section(QFrame):
    """A heading over a column of widgets."""

    def __init__(self, title: str) -> None:
        super().__init__()
        self.setObjectName("section")
        self.column = QVBoxLayout(self)
        self.column.setContentsMargins(0, 4, 0, 8)
        self.column.setSpacing(6)
        heading = QLabel(title)
        heading.setProperty("heading", True)
        self.column.addWidget(heading)

    def add_row(self, *widgets: QWidget) -> None:
        """Add widgets side by side; they share the width."""
        row = QHBoxLayout()
        row.setSpacing(6)
        for widget in widgets:
            row.addWidget(widget, 1)
        self.column.addLayout(row)

    def add_text(self) -> QLabel:
        """Add a quiet text of several lines that is no markup."""
        text = QLabel()
        text.setProperty("quiet", True)
        text.setWordWrap(True)
        text.setTextFormat(Qt.TextFormat.PlainText)
        self.column.addWidget(text)
        return text


class SteadyChoice(QComboBox):
    """A choice that the wheel does not change."""

    def __init__(self, name: str) -> None:
        super().__init__()
        self.setAccessibleName(name)
        self.setToolTip(plain_tip(name))
        self.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.setMinimumContentsLength(6)

    def wheelEvent(self, event: QWheelEvent) -> None:  # noqa: N802 (Qt's name)
        """Leave the wheel to what scrolls."""
        event.ignore()


def button(text: str, run: Callable[[], object], tip: str = "") -> QPushButton:
    """Return a push button that does something."""
    made = QPushButton(text)
    if tip:
        made.setToolTip(plain_tip(tip))
    made.clicked.connect(lambda _: run())
    return made


def show_text(label: QLabel, text: str) -> None:
    """Show a text; an empty one takes no room."""
    if label.text() != text:
        label.setText(text)
    label.setVisible(bool(text))
