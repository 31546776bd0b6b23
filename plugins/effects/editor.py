"""The selected effect: its formulation, source axis, and parameters."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFrame, QLabel, QScrollArea, QSizePolicy, QWidget

from rotemina.app.display_units import label
from rotemina.app.widgets.controls import plain_tip, set_property
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_column, in_grid, in_row
from rotemina.app.widgets.wheel_safe import SteadyChoice
from rotemina.plugins.effects import mark, tr
from rotemina.plugins.effects.parameter_display import Quantity
from rotemina.plugins.effects.parameter_field import ParameterField
from rotemina.plugins.effects.words import effect_summary, effect_title, formulation_name
from rotemina.sim.effects.attachment import Attached
from rotemina.sim.robot.model import Robot

NOTHING = mark("Add an effect and adjust it while the simulator runs.")
LEAST_HEIGHT = 10  # of the fields, which scroll: a notice must not make the window taller


class Editor(QWidget):
    """Fields for one effect; empty without one.

    Signals
    -------
    value_changed(str, float) : a parameter's name and value, SI.
    value_refused(str, str) : a parameter's name, and why what was typed is not applied.
    formulation_chosen(str), source_chosen(str)
    """

    value_changed = Signal(str, float)
    value_refused = Signal(str, str)
    formulation_chosen = Signal(str)
    source_chosen = Signal(str)

    def __init__(self, robot: Robot) -> None:
        super().__init__()
        self._robot = robot
        self._shown: object = None
        self.fields: dict[str, ParameterField] = {}
        self.title = plain_text(tr(NOTHING), quiet=False)
        self.formulation = SteadyChoice(
            tr("Formulation"), tr("Formulation of the effect; its equations appear below")
        )
        self.formulation.activated.connect(
            lambda: self.formulation_chosen.emit(self.formulation.currentData())
        )
        self._from = QLabel(tr("from"))
        self.source = SteadyChoice(tr("Axis in which the effect originates"))
        self.source.activated.connect(lambda: self.source_chosen.emit(self.source.currentData()))
        self.equation = plain_text()
        # A long equation must not widen the window; its tooltip has all of it.
        self.equation.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self._scroll = QScrollArea()
        self._scroll.setObjectName("panelScroll")
        self._scroll.setFrameShape(QFrame.Shape.NoFrame)
        self._scroll.setWidgetResizable(True)
        self._scroll.setMinimumHeight(LEAST_HEIGHT)
        self._lay_out()
        self.show_effect(None, -1)

    def _lay_out(self) -> None:
        head = in_row(self.title, 1, self.formulation, self._from, self.source, spacing=6)
        in_column(head, self.equation, (self._scroll, 1), on=self, margins=(8, 0, 0, 0), spacing=3)

    def show_effect(self, one: Attached | None, place: int) -> None:
        """Show an effect at its place in the list, or that there is none."""
        shown = None
        if one is not None:
            shown = (place, one.asked.axis, one.effect, one.formulation, one.asked.from_axis)
        anew = shown != self._shown
        self._shown = shown
        if anew:
            self._show_head(one)
            self._make_fields(one)
        for name, value in (one.values if one is not None else {}).items():
            self.fields[name].show_value(value, anew=anew)

    def _show_head(self, one: Attached | None) -> None:
        for widget in (self.formulation, self.equation):
            widget.setVisible(one is not None)
        for widget in (self._from, self.source):
            widget.setVisible(one is not None and one.effect.coupled)
        set_property(self.title, "quiet", one is None)
        set_property(self.title, "heading", one is not None)
        if one is None:
            self.title.setText(tr(NOTHING))
            self.title.setToolTip("")
            return
        self.title.setText(f"{label(one.asked.axis)}: {effect_title(one.effect)}")
        self.title.setToolTip(plain_tip(effect_summary(one.effect)))
        self.equation.setText(" ".join(one.formulation.equation.split()))
        self.equation.setToolTip(plain_tip(one.formulation.equation, one.formulation.source))
        names = [formulation.name for formulation in one.effect.formulations]
        _offer(
            self.formulation,
            [(formulation_name(name), name) for name in names],
            one.formulation.name,
        )
        self.formulation.setEnabled(len(names) > 1)
        others = [name for name in self._robot.axes if name != one.asked.axis]
        _offer(self.source, [(label(name), name) for name in others], one.asked.from_axis)

    def _make_fields(self, one: Attached | None) -> None:
        for field in self.fields.values():
            field.retire()
        self.fields = {}
        content = QWidget()
        grid = in_grid(on=content, margins=(0, 2, 4, 2), spacing=(-1, 3), stretched=3)
        if one is not None:
            source = one.asked.from_axis
            source_unit = (self._robot.unit(source) or "m") if source is not None else ""
            for row, parameter in enumerate(one.formulation.parameters):
                quantity = Quantity.of(parameter, one.facts, source_unit)
                field = ParameterField(parameter.name, quantity, content)
                field.changed.connect(self.value_changed)
                field.refused.connect(self.value_refused)
                field.place(grid, row)
                self.fields[parameter.name] = field
        grid.setRowStretch(grid.rowCount(), 1)
        self._scroll.setWidget(content)


def _offer(choice: SteadyChoice, items: list[tuple[str, str]], chosen: str | None) -> None:
    choice.clear()
    for text, data in items:
        choice.addItem(text, data)
    choice.setCurrentIndex(choice.findData(chosen))
