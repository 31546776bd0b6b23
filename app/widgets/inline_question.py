"""A question inside a panel, before an action that must not happen by accident."""

from collections.abc import Callable

from PySide6.QtWidgets import QFrame, QHBoxLayout, QVBoxLayout

from rotemina.app.shell.language import translate
from rotemina.app.widgets.controls import button
from rotemina.app.widgets.labels import plain_text


class Question(QFrame):
    """A question within a panel: everything else, the stop among it, stays within reach."""

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("question")
        self.text = plain_text(quiet=False, wrap=True)
        self.yes = button(
            translate("widgets", "Yes"),
            self._agree,
            translate("widgets", "Confirm"),
        )
        self.no = button(
            translate("widgets", "Cancel"), self.hide, translate("widgets", "Change nothing")
        )
        row = QHBoxLayout()
        row.setSpacing(6)
        row.addWidget(self.yes, 1)
        row.addWidget(self.no, 1)
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 6, 8, 8)
        column.addWidget(self.text)
        column.addLayout(row)
        self._then: Callable[[], object] = lambda: None
        self.hide()

    def ask(self, text: str, answer: str, then: Callable[[], object]) -> None:
        """Ask; do ``then`` if that is wanted."""
        self.text.setText(text)
        self.yes.setText(answer)
        self._then = then
        self.show()
        self.no.setFocus()  # what Enter chooses

    def _agree(self) -> None:
        self.hide()
        self._then()
