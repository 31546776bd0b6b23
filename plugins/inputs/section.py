"""Parts of the panel: a heading over a column, texts, buttons, choices that the wheel leaves."""

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import (
    QComboBox,
    QFrame,
    QHBoxLayout,
    QLabel,
    QLayout,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from rotemina.app.shell.controls import ElidedLabel


class Section(QFrame):
    """A heading over a column of widgets."""

    def __init__(self, title: str) -> None:
        super().__init__()
        self.setObjectName("section")
        self.column = QVBoxLayout(self)
        self.column.setContentsMargins(0, 4, 0, 8)
        self.column.setSpacing(6)
        self.heading = ElidedLabel()
        self.heading.setProperty("heading", True)
        self.heading.show_text(title)
        self.column.addWidget(self.heading)

    def add_row(self, *widgets: QWidget) -> QHBoxLayout:
        """Add widgets side by side; the first takes what room there is."""
        row = QHBoxLayout()
        row.setSpacing(6)
        for number, widget in enumerate(widgets):
            row.addWidget(widget, 0 if number else 1)
        self.column.addLayout(row)
        return row

    def add_text(self) -> QLabel:
        """Add a quiet text of several lines."""
        text = quiet_text()
        self.column.addWidget(text)
        return text


class SteadyChoice(QComboBox):
    """A choice as narrow as there is room for, which the wheel does not change."""

    def __init__(self, name: str) -> None:
        super().__init__()
        self.setAccessibleName(name)
        self.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.setMinimumContentsLength(8)

    def select(self, value: object) -> None:
        """Show a value without telling that it was chosen."""
        index = self.findData(value)
        if index != self.currentIndex():
            self.setCurrentIndex(index)

    def wheelEvent(self, event: QWheelEvent) -> None:  # noqa: N802 (Qt's name)
        """Leave the wheel to what scrolls."""
        event.ignore()


def quiet_text() -> QLabel:
    """Return an empty label for text of several lines that is no markup."""
    text = QLabel()
    text.setProperty("quiet", True)
    text.setWordWrap(True)
    text.setTextFormat(Qt.TextFormat.PlainText)
    return text


def button(text: str, run: Callable[[], object]) -> QPushButton:
    """Return a push button that does something."""
    made = QPushButton(text)
    made.clicked.connect(lambda _: run())
    return made


def show_text(text: QLabel, words: str) -> None:
    """Show words, and nothing at all where there are none."""
    if words != text.text():
        text.setText(words)
    if text.isHidden() is bool(words):
        text.setVisible(bool(words))


def clear(layout: QLayout) -> None:
    """Take everything out of a layout."""
    while (item := layout.takeAt(0)) is not None:
        widget = item.widget()
        if widget is not None:
            widget.hide()
            widget.deleteLater()
