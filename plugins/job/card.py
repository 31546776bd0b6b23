"""One thing that runs: its name, how far it is, and what can be done with it."""

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFrame, QGridLayout, QHBoxLayout, QLabel, QProgressBar, QPushButton

from rotemina.app.widgets.controls import allow, fill
from rotemina.app.widgets.labels import ElidedLabel
from rotemina.plugins.job.words import Running

_STEPS = 1000


class Card(QFrame):
    """Shows how something stands, with a row of buttons below it."""

    def __init__(self, kind: str) -> None:
        super().__init__()
        self.setObjectName("section")
        self.name, self.doing = ElidedLabel(), ElidedLabel()
        self.kind, self.time = QLabel(kind), QLabel()
        self.time.setTextFormat(Qt.TextFormat.PlainText)
        for quiet in (self.kind, self.doing):
            quiet.setProperty("quiet", True)
        self.name.setProperty("heading", True)
        self.bar = QProgressBar()
        self.bar.setRange(0, _STEPS)
        self.bar.setTextVisible(False)
        self.bar.setAccessibleName(kind)
        self._buttons = QHBoxLayout()
        self._buttons.setSpacing(6)
        self._buttons.addStretch(1)
        grid = QGridLayout(self)
        grid.setContentsMargins(2, 4, 2, 6)
        grid.setVerticalSpacing(3)
        grid.setColumnStretch(0, 1)
        grid.addWidget(self.kind, 0, 0)
        grid.addWidget(self.time, 0, 1)
        for row, widget in enumerate((self.name, self.doing, self.bar), start=1):
            grid.addWidget(widget, row, 0, 1, 2)
        grid.addLayout(self._buttons, 4, 0, 1, 2)

    def add_button(self, text: str, tip: str, run: Callable[[], object]) -> QPushButton:
        """Add a button at the right."""
        button = QPushButton(text)
        button.clicked.connect(lambda _: run())
        allow(button, None, tip)
        self._buttons.addWidget(button)
        return button

    def show_running(self, running: Running | None) -> None:
        """Show how it stands; None hides the card."""
        self.setVisible(running is not None)
        if running is None:
            return
        self.name.show_text(running.name)
        self.doing.show_text(running.doing)
        self.doing.setVisible(bool(running.doing))
        if self.time.text() != running.time:
            self.time.setText(running.time)
        self.bar.setVisible(running.share is not None)
        if running.share is not None:
            fill(self.bar, round(_STEPS * running.share))
