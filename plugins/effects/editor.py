"""Editor of the chosen effect: its formulation, source axis and parameters."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFrame, QLabel, QScrollArea, QSizePolicy, QWidget

from rotemina.app.language import get_axis_label
from rotemina.app.widgets.controls import WheelSafeComboBox, make_tooltip, set_property
from rotemina.app.widgets.layout import (
    make_column,
    make_grid,
    make_row,
)
from rotemina.app.widgets.text import make_plain_label
from rotemina.plugins.effects import mark, tr
from rotemina.plugins.effects.parameter_display import DisplayedParameter
from rotemina.plugins.effects.parameter_field import ParameterField
from rotemina.plugins.effects.words import effect_summary, effect_title, formulation_name
from rotemina.sim.effects import AttachedEffect
from rotemina.sim.robot import Robot

EMPTY_TEXT = mark("Add an effect and adjust it while the simulator runs.")

# The fields can scroll, so their area may shrink to almost nothing. Otherwise a notice above them
# would make the window taller.
MIN_FIELDS_HEIGHT_PX = 10


class EffectEditor(QWidget):
    """Editor of one effect, or a hint if there is none.

    Signals
    -------
    value_changed(str, float) : name and value (SI) of a parameter.
    value_refused(str, str) : name of a parameter, and why the typed text is not applied.
    formulation_chosen(str), source_chosen(str)
    """

    value_changed = Signal(str, float)
    value_refused = Signal(str, str)
    formulation_chosen = Signal(str)
    source_chosen = Signal(str)

    def __init__(self, robot: Robot) -> None:
        super().__init__()
        self._robot = robot
        self._shown_identity: object = None
        self.fields: dict[str, ParameterField] = {}
        self.title = make_plain_label(tr(EMPTY_TEXT), quiet=False)
        self.formulation = WheelSafeComboBox(
            tr("Formulation"), tr("Formulation of the effect; its equations appear below")
        )
        self.formulation.activated.connect(
            lambda: self.formulation_chosen.emit(self.formulation.currentData())
        )
        self._source_label = QLabel(tr("from"))
        self.source = WheelSafeComboBox(tr("Axis in which the effect originates"))
        self.source.activated.connect(lambda: self.source_chosen.emit(self.source.currentData()))
        self.equation = make_plain_label()
        # A long equation must not widen the window. Its tooltip shows the whole text.
        self.equation.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self._scroll = QScrollArea()
        self._scroll.setObjectName("panelScroll")
        self._scroll.setFrameShape(QFrame.Shape.NoFrame)
        self._scroll.setWidgetResizable(True)
        self._scroll.setMinimumHeight(MIN_FIELDS_HEIGHT_PX)
        self._lay_out()
        self.show_effect(None, -1)

    def _lay_out(self) -> None:
        header = make_row(
            self.title, 1, self.formulation, self._source_label, self.source, spacing=6
        )
        make_column(
            header, self.equation, (self._scroll, 1), on=self, margins=(8, 0, 0, 0), spacing=3
        )

    def show_effect(self, attached: AttachedEffect | None, index: int) -> None:
        """Show the effect at an index in the list, or a hint if ``attached`` is None."""
        identity = None
        if attached is not None:
            identity = (
                index,
                attached.entry.axis,
                attached.effect,
                attached.formulation,
                attached.entry.from_axis,
            )
        is_new = identity != self._shown_identity
        self._shown_identity = identity
        if is_new:
            self._show_header(attached)
            self._make_fields(attached)
        for name, value in (attached.values if attached is not None else {}).items():
            self.fields[name].show_value(value, overwrite=is_new)

    def _show_header(self, attached: AttachedEffect | None) -> None:
        for widget in (self.formulation, self.equation):
            widget.setVisible(attached is not None)
        for widget in (self._source_label, self.source):
            widget.setVisible(attached is not None and attached.effect.coupled)
        set_property(self.title, "quiet", attached is None)
        set_property(self.title, "heading", attached is not None)
        if attached is None:
            self.title.setText(tr(EMPTY_TEXT))
            self.title.setToolTip("")
            return
        self.title.setText(
            f"{get_axis_label(attached.entry.axis)}: {effect_title(attached.effect)}"
        )
        self.title.setToolTip(make_tooltip(effect_summary(attached.effect)))
        self.equation.setText(" ".join(attached.formulation.equation.split()))
        self.equation.setToolTip(
            make_tooltip(attached.formulation.equation, attached.formulation.source)
        )
        names = [formulation.name for formulation in attached.effect.formulations]
        _offer_items(
            self.formulation,
            [(formulation_name(name), name) for name in names],
            attached.formulation.name,
        )
        self.formulation.setEnabled(len(names) > 1)
        others = [name for name in self._robot.axes if name != attached.entry.axis]
        _offer_items(
            self.source, [(get_axis_label(name), name) for name in others], attached.entry.from_axis
        )

    def _make_fields(self, attached: AttachedEffect | None) -> None:
        for field in self.fields.values():
            field.stop_reporting()
        self.fields = {}
        content = QWidget()
        grid = make_grid(on=content, margins=(0, 2, 4, 2), spacing=(-1, 3), stretched=3)
        if attached is not None:
            source = attached.entry.from_axis
            source_unit = (self._robot.unit(source) or "m") if source is not None else ""
            for row, parameter in enumerate(attached.formulation.parameters):
                quantity = DisplayedParameter.from_parameter(parameter, attached.facts, source_unit)
                field = ParameterField(parameter.name, quantity, content)
                field.changed.connect(self.value_changed)
                field.refused.connect(self.value_refused)
                field.add_to_grid(grid, row)
                self.fields[parameter.name] = field
        grid.setRowStretch(grid.rowCount(), 1)
        self._scroll.setWidget(content)


def _offer_items(
    choice: WheelSafeComboBox, items: list[tuple[str, str]], selected: str | None
) -> None:
    choice.clear()
    for text, data in items:
        choice.addItem(text, data)
    choice.setCurrentIndex(choice.findData(selected))
