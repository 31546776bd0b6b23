"""Widgets for one parameter of an effect: a field with its unit, a slider, and a reset button."""

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QGridLayout, QLineEdit, QToolButton, QWidget

from rotemina.app.language import describe_error
from rotemina.app.widgets.controls import (
    WheelSafeSlider,
    make_tooltip,
    name_widget,
    set_property,
)
from rotemina.app.widgets.text import make_plain_label
from rotemina.plugins.effects import tr
from rotemina.plugins.effects.parameter_display import (
    SLIDER_STEPS,
    DisplayedParameter,
    ValueRefusedError,
)
from rotemina.plugins.effects.words import format_name, translate_meaning


class ParameterField(QObject):
    """Widgets of one parameter in a row of a grid.

    Signals
    -------
    changed(str, float) : name and value (SI) of the parameter.
    refused(str, str) : name of the parameter, and why the typed text is not applied.
    """

    changed = Signal(str, float)
    refused = Signal(str, str)

    def __init__(self, name: str, quantity: DisplayedParameter, parent: QWidget) -> None:
        super().__init__(parent)
        self.name, self.quantity = name, quantity
        self._value = quantity.preset
        self._refused_text = ""
        preset = quantity.format_value(quantity.preset)
        tooltip = make_tooltip(
            f"{format_name(name)}: {translate_meaning(quantity.meaning)}",
            tr("Must be {range}").format(range=quantity.range_text),
            tr("Preset {value}").format(value=preset),
        )
        self._title = make_plain_label(format_name(name), quiet=False)
        self.edit = name_widget(QLineEdit(), f"{name} {quantity.unit}".rstrip())
        self.edit.setFixedWidth(92)
        self.edit.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.edit.editingFinished.connect(self._commit)
        self._unit = make_plain_label(quantity.unit, quiet=False)
        self.slider = WheelSafeSlider(name, SLIDER_STEPS)
        self.slider.setPageStep(SLIDER_STEPS // 20)
        self.slider.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.slider.valueChanged.connect(self._on_slider_moved)
        self.slider.setVisible(quantity.bounded)
        self.reset = QToolButton()
        self.reset.setText("↺")
        self.reset.setAccessibleName(tr("Reset {name} to its preset").format(name=name))
        self.reset.setToolTip(make_tooltip(tr("Reset to the preset, {value}").format(value=preset)))
        self.reset.clicked.connect(lambda: self._apply_value(quantity.preset))
        for widget in (self._title, self.edit, self._unit, self.slider):
            widget.setToolTip(tooltip)

    def add_to_grid(self, grid: QGridLayout, row: int) -> None:
        """Put the widgets into a row of a grid."""
        widgets = (self._title, self.edit, self._unit, self.slider, self.reset)
        for column, widget in enumerate(widgets):
            if widget is not self.slider or self.quantity.bounded:
                grid.addWidget(widget, row, column)

    def show_value(self, value: float, *, overwrite: bool = False) -> None:
        """Show a value (SI). With ``overwrite``, also replace a text that was refused."""
        if not overwrite and value == self._value and self.is_not_applied:
            return
        self._value = value
        self.edit.setText(self.quantity.format_number(value))
        self.edit.setCursorPosition(0)
        if self.quantity.bounded:
            self.slider.blockSignals(True)
            self.slider.setValue(self.quantity.to_slider(value))
            self.slider.blockSignals(False)
        self.reset.setEnabled(value != self.quantity.preset)
        self._refused_text = ""
        self.set_not_applied(False)

    @property
    def is_not_applied(self) -> bool:
        """Whether the field is marked because the simulator does not use its value."""
        return bool(self.edit.property("bad"))

    def set_not_applied(self, state: bool) -> None:
        """Mark the field as not applied, or remove the mark."""
        set_property(self.edit, "bad", state)

    def unmark_if_applied(self) -> None:
        """Remove the mark if the field shows the applied value."""
        if self.edit.text() == self.quantity.format_number(self._value):
            self.set_not_applied(False)

    def stop_reporting(self) -> None:
        """Block all signals, so that a field removed while it is edited changes nothing."""
        self.blockSignals(True)

    def _commit(self) -> None:
        text = self.edit.text()
        if text == self.quantity.format_number(self._value):
            if self._refused_text:
                self._refused_text = ""
                self.set_not_applied(False)
            # The value has more digits than the text, and must not be rounded to it.
            return
        try:
            value = self.quantity.parse_value(text)
        except ValueRefusedError as error:
            was_reported = self.is_not_applied and text == self._refused_text
            self._refused_text = text
            self.set_not_applied(True)
            # Pressing Enter and leaving the field both get here, and one notice is enough.
            if not was_reported:
                self.refused.emit(self.name, describe_error(error))
            return
        self._apply_value(value)

    def _on_slider_moved(self, slider_value: int) -> None:
        self._apply_value(self.quantity.from_slider(slider_value), from_slider=True)

    def _apply_value(self, value: float, *, from_slider: bool = False) -> None:
        if from_slider:
            self.slider.blockSignals(True)
        self.show_value(value, overwrite=True)
        self.slider.blockSignals(False)
        self.changed.emit(self.name, value)
