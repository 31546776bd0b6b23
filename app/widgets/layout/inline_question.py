"""A question inside a panel, before an action that must not happen by accident."""

from collections.abc import Callable

from PySide6.QtWidgets import QFrame, QHBoxLayout, QVBoxLayout

from rotemina.app.language import translate
from rotemina.app.widgets.controls import make_button
from rotemina.app.widgets.text import make_plain_label


class InlineQuestion(QFrame):
    """Question inside a panel; everything else, including the stop, stays usable."""

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("question")
        self.text = make_plain_label(quiet=False, wrap=True)
        self.yes = make_button(
            translate("widgets", "Yes"),
            self._agree,
            translate("widgets", "Confirm"),
        )
        self.no = make_button(
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
        self._action: Callable[[], object] = lambda: None
        self.hide()

    def ask(self, text: str, answer: str, then: Callable[[], object]) -> None:
        """Ask a question; call ``then`` if the answer is yes."""
        self.text.setText(text)
        self.yes.setText(answer)
        self._action = then
        self.show()
        # Enter then chooses the safe answer.
        self.no.setFocus()

    def _agree(self) -> None:
        self.hide()
        self._action()
