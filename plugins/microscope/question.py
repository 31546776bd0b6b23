"""A large move is asked about first, below the picture and beside the stop button."""

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel

from rotemina.app.shell.language import translate
from rotemina.app.widgets.controls import button


class Question(QFrame):
    """One question with a yes and a no; Enter and the space bar answer neither by accident."""

    def __init__(self, yes: str, answer: Callable[[bool], None]) -> None:
        super().__init__()
        self.setObjectName("question")
        self.text = QLabel()
        self.text.setTextFormat(Qt.TextFormat.PlainText)
        self.text.setWordWrap(True)
        self.yes = button(yes, lambda: answer(True), translate("microscope", "Move the tip"))
        self.yes.setProperty("primary", True)
        self.no = button(
            translate("microscope", "Cancel"),
            lambda: answer(False),
            translate("microscope", "Do not move"),
        )
        for one in (self.yes, self.no):
            one.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        row = QHBoxLayout(self)
        row.setContentsMargins(8, 4, 8, 4)
        row.addWidget(self.text, 1)
        row.addWidget(self.yes)
        row.addWidget(self.no)
        self.hide()

    def ask(self, text: str) -> None:
        """Show the question; an empty one hides it."""
        self.text.setText(text)
        self.setVisible(bool(text))
