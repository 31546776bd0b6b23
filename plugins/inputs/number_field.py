"""Field for one number with a unit. Invalid input is refused and marked."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QLineEdit, QWidget

from rotemina.app.widgets.controls import make_tooltip, set_property
from rotemina.plugins.inputs import tr
from rotemina.sim.messages import format_rounded, parse_number


class BoundedNumberField(QLineEdit):
    """Field for one number between two bounds.

    Parameters
    ----------
    name, unit : str
        The accessible name of the field, and its unit.
    about : str
        The tooltip, to which the bounds are added.
    low, high : float
        The bounds in the shown unit.
    optional : bool
        Whether the field may be empty.

    Signals
    -------
    entered(object)
        Emitted with the number that the operator has typed, or None if the field was emptied.
    """

    entered = Signal(object)

    def __init__(
        self,
        name: str,
        unit: str,
        about: str,
        low: float,
        high: float,
        *,
        optional: bool = False,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self._unit, self._low, self._high, self._optional = unit, low, high, optional
        self._bounds = (
            tr("{low:g} to {high:g} {unit}").format(low=low, high=high, unit=unit).rstrip()
        )
        self._tooltip = f"{about}: {self._bounds}" + (tr(", or empty") if optional else "")
        self._value: float | None = None
        self._problem = ""
        self.setAccessibleName(f"{name}, {unit}" if unit else name)
        self.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.setToolTip(make_tooltip(self._tooltip))
        self.editingFinished.connect(self._on_edited)

    def show_number(self, value: float | None) -> None:
        """Show a number, unless the operator is typing or has typed an invalid text."""
        self._value = value
        if not self.hasFocus() and not self._problem:
            self.setText(self._format_value())

    def reset(self, value: float | None) -> None:
        """Show a number, and discard a typed text."""
        self._value = value
        self._mark_problem("")
        self.setText(self._format_value())

    def _format_value(self) -> str:
        return "" if self._value is None else format_rounded(self._value)

    def _on_edited(self) -> None:
        text = self.text().strip()
        if text == self._format_value():
            self._mark_problem("")
            return
        number = parse_number(text)
        if not text and self._optional:
            self._accept_value(None)
        elif number is None:
            self._mark_problem(
                tr("{text!r} is not a number; enter one with a decimal point, {bounds}").format(
                    text=text, bounds=self._bounds
                )
            )
        elif not self._low <= number <= self._high:
            self._mark_problem(
                tr("{value} is outside {bounds}").format(
                    value=f"{text} {self._unit}".rstrip(), bounds=self._bounds
                )
            )
        else:
            self._accept_value(number)

    def _accept_value(self, value: float | None) -> None:
        self._value = value
        self._mark_problem("")
        self.entered.emit(value)

    def _mark_problem(self, problem: str) -> None:
        self._problem = problem
        set_property(self, "bad", bool(problem))
        self.setToolTip(make_tooltip(self._tooltip, problem))
