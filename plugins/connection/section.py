"""One part of the panel: a heading, and what stands under it."""

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from rotemina.app.shell.language import translate


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

    def add_row(self, *widgets: QPushButton) -> QHBoxLayout:
        """Add widgets side by side; they share the width."""
        row = QHBoxLayout()
        row.setSpacing(6)
        for widget in widgets:
            row.addWidget(widget, 1)
        self.column.addLayout(row)
        return row

    def add_text(self) -> QLabel:
        """Add a quiet text of several lines."""
        text = quiet_text()
        self.column.addWidget(text)
        return text


class Figures(QWidget):
    """Names and values in two columns."""

    def __init__(self, *names: str) -> None:
        super().__init__()
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(12)
        grid.setVerticalSpacing(3)
        grid.setColumnStretch(1, 1)
        self.values: dict[str, QLabel] = {}
        for row, name in enumerate(names):
            title, value = QLabel(translate("connection", name)), QLabel("–")
            title.setProperty("quiet", True)
            value.setTextFormat(Qt.TextFormat.PlainText)
            value.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
            value.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
            value.setAccessibleName(title.text())
            grid.addWidget(title, row, 0)
            grid.addWidget(value, row, 1)
            self.values[name] = value

    def show_values(self, *texts: str) -> None:
        """Show texts in the order of the names."""
        for value, text in zip(self.values.values(), texts, strict=True):
            value.setText(text)


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
