"""Fields of the form: numbers with units, and choices that ignore the wheel."""

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QLabel, QLineEdit

from rotemina.app.shell.engine_words import error_text
from rotemina.app.widgets.controls import named, plain_tip, set_property
from rotemina.plugins.penetration.parameter_quantities import Quantity, TypedError


class NumberField(QObject):
    """One number: its title, its field and its unit.

    Signals
    -------
    changed() : another text was entered.
    """

    changed = Signal()

    def __init__(self, quantity: Quantity, parent: QObject) -> None:
        super().__init__(parent)
        self.quantity = quantity
        self._value: float | None = None
        self._read = ""
        self.title, self.unit = QLabel(quantity.shown_title), QLabel(quantity.unit)
        self.unit.setProperty("quiet", True)
        self.edit = named(QLineEdit(), quantity.name)
        self.edit.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.edit.setMinimumWidth(54)
        self.edit.setMaximumWidth(90)
        self.title.setBuddy(self.edit)
        for widget in (self.title, self.edit, self.unit):
            widget.setToolTip(plain_tip(*quantity.tip))
        self.edit.editingFinished.connect(self._enter)

    @property
    def value(self) -> float:
        """What the field means, SI.

        Raises
        ------
        TypedError
            If that is no number within the bounds.
        """
        text = self.edit.text()
        if self._value is not None and text == self._read:
            return self._value  # what is shown has fewer digits than what is meant
        return self.quantity.value(text)

    def show_value(self, value: float) -> None:
        """Show a value, SI."""
        self._value, self._read = value, self.quantity.number(value)
        self.edit.setText(self._read)
        self.edit.setCursorPosition(0)
        self.complaint()

    def complaint(self) -> str | None:
        """Return the problem of the text and mark the field, or None."""
        wrong = None
        try:
            self.value  # noqa: B018 (whether it can be read)
        except TypedError as error:
            wrong = error_text(error)
        set_property(self.edit, "bad", wrong is not None)
        self.edit.setToolTip(plain_tip(*self.quantity.tip, wrong or ""))
        return wrong

    def set_visible(self, visible: bool) -> None:
        """Show the row, or hide it."""
        for widget in (self.title, self.edit, self.unit):
            widget.setVisible(visible)

    def _enter(self) -> None:
        if self.edit.text() != self._read:
            self.changed.emit()
