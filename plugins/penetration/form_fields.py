"""Number with its unit in the form of parameters."""

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QLabel, QLineEdit

from rotemina.app.language import describe_error
from rotemina.app.widgets.controls import (
    make_tooltip,
    name_widget,
    set_property,
)
from rotemina.plugins.penetration.parameter_quantities import ParameterInputError, ParameterQuantity


class ParameterNumberField(QObject):
    """Number in the form: title, edit field and unit.

    Signals
    -------
    changed() : the operator has entered another text.
    """

    changed = Signal()

    def __init__(self, quantity: ParameterQuantity, parent: QObject) -> None:
        super().__init__(parent)
        self.quantity = quantity
        self._shown_value: float | None = None
        self._shown_text = ""
        self.title, self.unit = QLabel(quantity.shown_title), QLabel(quantity.unit)
        self.unit.setProperty("quiet", True)
        self.edit = name_widget(QLineEdit(), quantity.name)
        self.edit.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.edit.setMinimumWidth(54)
        self.edit.setMaximumWidth(90)
        self.title.setBuddy(self.edit)
        for widget in (self.title, self.edit, self.unit):
            widget.setToolTip(make_tooltip(*quantity.tip))
        self.edit.editingFinished.connect(self._on_edited)

    @property
    def value(self) -> float:
        """The value of the field, SI.

        Raises
        ------
        ParameterInputError
            If the text is not a number within the bounds.
        """
        text = self.edit.text()
        if self._shown_value is not None and text == self._shown_text:
            # The displayed text has fewer digits than the value.
            return self._shown_value
        return self.quantity.parse_value(text)

    def show_value(self, value: float) -> None:
        """Show a value, SI."""
        self._shown_value, self._shown_text = value, self.quantity.format_number(value)
        self.edit.setText(self._shown_text)
        self.edit.setCursorPosition(0)
        self.check_text()

    def check_text(self) -> str | None:
        """Return the problem of the text, or None, and mark the field accordingly."""
        problem = None
        try:
            self.value  # noqa: B018 (only to see whether it raises)
        except ParameterInputError as error:
            problem = describe_error(error)
        set_property(self.edit, "bad", problem is not None)
        self.edit.setToolTip(make_tooltip(*self.quantity.tip, problem or ""))
        return problem

    def set_visible(self, visible: bool) -> None:
        """Show or hide the row."""
        for widget in (self.title, self.edit, self.unit):
            widget.setVisible(visible)

    def _on_edited(self) -> None:
        if self.edit.text() != self._shown_text:
            self.changed.emit()
