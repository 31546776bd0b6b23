"""One parameter of an effect: a field with unit, a slider, and a reset to the preset."""

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QGridLayout, QLineEdit, QToolButton, QWidget

from rotemina.app.shell.engine_words import error_text
from rotemina.app.widgets.controls import named, plain_tip, set_property
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.wheel_safe import SteadySlider
from rotemina.plugins.effects import tr
from rotemina.plugins.effects.parameter_display import SLIDER_STEPS, Quantity, ValueRefusedError
from rotemina.plugins.effects.words import meaning_of, spoken


class ParameterField(QObject):
    """The widgets of one parameter in a row of a grid.

    Signals
    -------
    changed(str, float) : name and value, SI.
    refused(str, str) : name, and why what was typed is not applied.
    """

    changed = Signal(str, float)
    refused = Signal(str, str)

    def __init__(self, name: str, quantity: Quantity, parent: QWidget) -> None:
        super().__init__(parent)
        self.name, self.quantity = name, quantity
        self._value = quantity.preset
        self._refused = ""
        preset = quantity.text(quantity.preset)
        about = plain_tip(
            f"{spoken(name)}: {meaning_of(quantity.meaning)}",
            tr("Must be {range}").format(range=quantity.range_text),
            tr("Preset {value}").format(value=preset),
        )
        self._title = plain_text(spoken(name), quiet=False)
        self.edit = named(QLineEdit(), f"{name} {quantity.unit}".rstrip())
        self.edit.setFixedWidth(92)
        self.edit.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.edit.editingFinished.connect(self._commit)
        self._unit = plain_text(quantity.unit, quiet=False)
        self.slider = SteadySlider(name, SLIDER_STEPS)
        self.slider.setPageStep(SLIDER_STEPS // 20)
        self.slider.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.slider.valueChanged.connect(self._slide)
        self.slider.setVisible(quantity.bounded)
        self.reset = QToolButton()
        self.reset.setText("↺")
        self.reset.setAccessibleName(tr("Reset {name} to its preset").format(name=name))
        self.reset.setToolTip(plain_tip(tr("Reset to the preset, {value}").format(value=preset)))
        self.reset.clicked.connect(lambda: self._take(quantity.preset))
        for widget in (self._title, self.edit, self._unit, self.slider):
            widget.setToolTip(about)

    def place(self, grid: QGridLayout, row: int) -> None:
        """Put the widgets into a row of a grid."""
        widgets = (self._title, self.edit, self._unit, self.slider, self.reset)
        for column, widget in enumerate(widgets):
            if widget is not self.slider or self.quantity.bounded:
                grid.addWidget(widget, row, column)

    def show_value(self, value: float, *, anew: bool = False) -> None:
        """Show a value (SI); a text that was refused stays until it changes, or ``again``."""
        if not anew and value == self._value and self.not_applied:
            return
        self._value = value
        self.edit.setText(self.quantity.number(value))
        self.edit.setCursorPosition(0)
        if self.quantity.bounded:
            self.slider.blockSignals(True)
            self.slider.setValue(self.quantity.place(value))
            self.slider.blockSignals(False)
        self.reset.setEnabled(value != self.quantity.preset)
        self._refused = ""
        self.set_not_applied(False)

    @property
    def not_applied(self) -> bool:
        """Whether the field shows what the simulator does not do."""
        return bool(self.edit.property("bad"))

    def set_not_applied(self, state: bool) -> None:
        """Mark the field, or take the mark away."""
        set_property(self.edit, "bad", state)

    def settle(self) -> None:
        """Take the mark away where the text is what was applied."""
        if self.edit.text() == self.quantity.number(self._value):
            self.set_not_applied(False)

    def retire(self) -> None:
        """Tell nothing any more: a field that goes while it is edited must change nothing."""
        self.blockSignals(True)

    def _commit(self) -> None:
        text = self.edit.text()
        if text == self.quantity.number(self._value):
            if self._refused:
                self._refused = ""
                self.set_not_applied(False)
            return  # what is shown has fewer digits than what is meant
        try:
            value = self.quantity.value(text)
        except ValueRefusedError as error:
            told = self.not_applied and text == self._refused
            self._refused = text
            self.set_not_applied(True)
            if not told:  # a field is left after its text was entered: one slip, one notice
                self.refused.emit(self.name, error_text(error))
            return
        self._take(value)

    def _slide(self, place: int) -> None:
        self._take(self.quantity.at(place), from_slider=True)

    def _take(self, value: float, *, from_slider: bool = False) -> None:
        if from_slider:
            self.slider.blockSignals(True)
        self.show_value(value, anew=True)
        self.slider.blockSignals(False)
        self.changed.emit(self.name, value)
