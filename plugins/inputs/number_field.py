"""A field for one number with its unit; invalid input is refused and marked."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QLineEdit, QWidget

from rotemina.app.widgets.controls import plain_tip, set_property
from rotemina.plugins.inputs import tr
from rotemina.sim.quantities import parsed, rounded


class NumberField(QLineEdit):
    """A field for one number.

    Parameters
    ----------
    name, unit, about : str
        Its accessible name, and what its tooltip says.
    low, high : float
        In the shown unit.
    optional : bool
        Whether it may be empty.

    Signals
    -------
    entered(object) : someone has typed another number; None: it was emptied.
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
        self._about = f"{about}: {self._bounds}" + (tr(", or empty") if optional else "")
        self._value: float | None = None
        self._wrong = ""
        self.setAccessibleName(f"{name}, {unit}" if unit else name)
        self.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.setToolTip(plain_tip(self._about))
        self.editingFinished.connect(self._commit)

    def show_number(self, value: float | None) -> None:
        """Show a number; what someone is typing stays."""
        self._value = value
        if not self.hasFocus() and not self._wrong:
            self.setText(self._shown())

    def reset(self, value: float | None) -> None:
        """Show a number, whatever was typed."""
        self._value = value
        self._mark("")
        self.setText(self._shown())

    def _shown(self) -> str:
        return "" if self._value is None else rounded(self._value)

    def _commit(self) -> None:
        text = self.text().strip()
        if text == self._shown():
            self._mark("")
            return
        number = parsed(text)
        if not text and self._optional:
            self._take(None)
        elif number is None:
            self._mark(
                tr("{text!r} is not a number; enter one with a decimal point, {bounds}").format(
                    text=text, bounds=self._bounds
                )
            )
        elif not self._low <= number <= self._high:
            self._mark(
                tr("{value} is outside {bounds}").format(
                    value=f"{text} {self._unit}".rstrip(), bounds=self._bounds
                )
            )
        else:
            self._take(number)

    def _take(self, value: float | None) -> None:
        self._value = value
        self._mark("")
        self.entered.emit(value)

    def _mark(self, wrong: str) -> None:
        self._wrong = wrong
        set_property(self, "bad", bool(wrong))
        self.setToolTip(plain_tip(self._about, wrong))
