"""Form for the parameters of a penetration. Typing in it moves nothing."""

from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QFrame,
    QGridLayout,
    QLabel,
    QPlainTextEdit,
    QPushButton,
    QToolButton,
    QWidget,
)

from rotemina.app.language import describe_error, get_axis_label, translate_message
from rotemina.app.motion.penetration import (
    CellDirection,
    InputShaping,
    PenetrationParameters,
    ThrustShape,
)
from rotemina.app.widgets.controls import WheelSafeComboBox, enable_unless, make_tooltip
from rotemina.app.widgets.layout import (
    FittedScrollArea,
    make_column,
    make_grid,
    make_row,
)
from rotemina.app.widgets.text import make_heading
from rotemina.plugins.penetration import mark, tr
from rotemina.plugins.penetration.form_fields import ParameterNumberField
from rotemina.plugins.penetration.parameter_quantities import (
    QUANTITIES,
    ParameterGroup,
    ParameterInputError,
    find_quantities,
)
from rotemina.plugins.penetration.thrust_table_text import EXAMPLE_TABLE, format_table, parse_table
from rotemina.sim.errors import InputError
from rotemina.sim.robot import Robot

_SHAPE_TEXTS = {
    ThrustShape.S_CURVE: mark("S-curve"),
    ThrustShape.MINIMUM_JERK: mark("minimum jerk"),
    ThrustShape.TABLE: mark("table"),
}
_SHAPING_TEXTS = {
    InputShaping.NONE: mark("none"),
    InputShaping.ZV: mark("ZV"),
    InputShaping.ZVD: mark("ZVD"),
    InputShaping.ZVDD: mark("ZVDD"),
    InputShaping.INVERSE: mark("inverse model"),
}
_TABLE_TOOLTIP_LINES = (
    mark("Points of the thrust, one per line: time share, depth share."),
    mark("From 0, 0 to 1, 1; 2 to 200 points."),
)


class ParameterForm(FittedScrollArea):
    """Form with the parameters by group. Leaving a field or pressing Enter reads all fields.

    Signals
    -------
    changed() : ``parameters`` or ``complaint`` has changed.
    """

    changed = Signal()

    def __init__(self, robot: Robot, parameters: PenetrationParameters) -> None:
        super().__init__()
        self.parameters, self.complaint = parameters, ""
        self.setObjectName("panelScroll")
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._body = QWidget()
        self.load, self.save = QPushButton(tr("Load …")), QPushButton(tr("Save …"))
        self.save.setToolTip(tr("Save these parameters to a TOML file"))
        self.fields = {
            key: ParameterNumberField(quantity, self) for key, quantity in QUANTITIES.items()
        }
        self._make_choices(robot)
        self._make_more_button()
        self._lay_out()
        self.show_parameters(parameters)
        self._connect()

    def show_parameters(self, parameters: PenetrationParameters) -> None:
        """Put parameters into the fields."""
        self.parameters, self.complaint = parameters, ""
        for key, field in self.fields.items():
            field.show_value(getattr(parameters, key))
        for key, choice in self.choices.items():
            value = str(getattr(parameters, key))
            # The parameters may name an axis of another robot.
            if choice.findData(value) < 0:
                choice.addItem(value, value)
            choice.select(value)
        self.table.blockSignals(True)
        self.table.setPlainText(format_table(parameters.table or EXAMPLE_TABLE))
        self.table.blockSignals(False)
        self._update_shape_fields()

    def read_fields(self) -> None:
        """Read every field, including one that is still being edited."""
        previous = self.parameters, self.complaint
        problems = [field.check_text() for field in self.fields.values()]
        self.complaint = next((problem for problem in problems if problem is not None), "")
        if not self.complaint:
            try:
                self.parameters = self._read_parameters()
            except InputError as error:
                self.complaint = describe_error(error)
        self._update_shape_fields()
        if (self.parameters, self.complaint) != previous:
            self.changed.emit()

    def allow_changes_unless(self, objection: str | None) -> None:
        """Allow changes, unless there is an objection. The fields stay readable in any case."""
        enable_unless(self._body, objection, "")
        enable_unless(self.load, objection, tr("Replace these parameters by those of a TOML file"))

    def _lay_out(self) -> None:
        make_column(
            *(self._make_section(group) for group in ParameterGroup),
            on=self._body,
            margins=0,
            spacing=2,
        )
        files = make_row((self.load, 1), (self.save, 1), spacing=6)
        content = QWidget()
        make_column(self._body, files, 1, on=content, margins=(0, 0, 8, 4))
        self.setWidget(content)

    def _make_choices(self, robot: Robot) -> None:
        axis = WheelSafeComboBox(
            tr("Axis of the penetration"), tr("Axis that penetrates the cell"), letters=8
        )
        for name in robot.axes:
            if robot.unit(name) == "m":
                axis.addItem(get_axis_label(name), name)
        direction = WheelSafeComboBox(
            tr("Direction"),
            tr("Direction of the cell along the axis; down: towards smaller positions"),
            letters=8,
        )
        shape = WheelSafeComboBox(
            tr("Shape of the thrust"), tr("Speed profile of the thrust"), letters=8
        )
        shaping = WheelSafeComboBox(
            tr("Input shaping"),
            tr(
                "Suppresses the resonance of the axis in the robot file. ZV, ZVD, ZVDD: "
                "impulses, increasingly slow and robust; inverse model: best tracking"
            ),
            letters=8,
        )
        for cell_direction in CellDirection:
            direction.addItem(translate_message(cell_direction), str(cell_direction))
        for thrust_shape, text in _SHAPE_TEXTS.items():
            shape.addItem(tr(text), str(thrust_shape))
        for input_shaping, text in _SHAPING_TEXTS.items():
            shaping.addItem(tr(text), str(input_shaping))
        self.choices = {"axis": axis, "direction": direction, "shape": shape, "shaping": shaping}
        self.table = QPlainTextEdit()
        self.table.setAccessibleName(tr("Table of the thrust: time share, depth share"))
        self.table.setToolTip(make_tooltip(*_get_table_tooltip()))
        self.table.setTabChangesFocus(True)
        self.table.setFixedHeight(86)

    def _make_more_button(self) -> None:
        self.more_button = QToolButton()
        self.more_button.setText(tr("More ▸"))
        self.more_button.setCheckable(True)
        self.more_button.setAccessibleName(tr("More settings of the contact detection"))
        self.more_button.setToolTip(
            tr("Settings that distinguish contact from noise, hysteresis and creep")
        )
        self._detection_fields = QWidget()
        self._detection_fields.hide()

    def _make_section(self, group: ParameterGroup) -> QWidget:
        section, body = QWidget(), QWidget()
        column = make_column(on=section, margins=(0, 0, 0, 2), spacing=2)
        column.addWidget(make_heading(tr(group)))
        if group is ParameterGroup.CONTACT:
            body = self._detection_fields
            column.addWidget(self.more_button, 0, Qt.AlignmentFlag.AlignLeft)
        column.addWidget(body)
        grid = make_grid(on=body, margins=0, spacing=(8, 3), stretched=0)
        if group is ParameterGroup.APPROACH:
            self._add_choice(grid, tr("Axis"), "axis")
            self._add_choice(grid, tr("Cell is"), "direction")
        if group is ParameterGroup.THRUST:
            self._add_choice(grid, tr("Shape"), "shape")
            self._add_choice(grid, tr("Shaping"), "shaping")
        for quantity in find_quantities(group):
            field, row = self.fields[quantity.key], grid.rowCount()
            for grid_column, widget in enumerate((field.title, field.edit, field.unit)):
                grid.addWidget(widget, row, grid_column)
        if group is ParameterGroup.THRUST:
            self._table_title = QLabel(tr("Time share, depth share"))
            grid.addWidget(self._table_title, grid.rowCount(), 0, 1, 3)
            grid.addWidget(self.table, grid.rowCount(), 0, 1, 3)
        return section

    def _add_choice(self, grid: QGridLayout, title: str, key: str) -> None:
        name, row = QLabel(title), grid.rowCount()
        name.setBuddy(self.choices[key])
        grid.addWidget(name, row, 0)
        grid.addWidget(self.choices[key], row, 1, 1, 2)

    def _connect(self) -> None:
        for field in self.fields.values():
            field.changed.connect(self.read_fields)
        for choice in self.choices.values():
            choice.activated.connect(lambda _: self.read_fields())
        self.table.textChanged.connect(self.read_fields)
        self.more_button.toggled.connect(self._show_more)

    def _read_parameters(self) -> PenetrationParameters:
        values: dict[str, Any] = {key: field.value for key, field in self.fields.items()}
        values |= {key: choice.currentData() for key, choice in self.choices.items()}
        has_table = values["shape"] == ThrustShape.TABLE
        values["table"] = parse_table(self.table.toPlainText()) if has_table else ()
        return PenetrationParameters(**values)

    def _update_shape_fields(self) -> None:
        shape = self.choices["shape"].currentData()
        self.fields["ramp"].set_visible(shape == ThrustShape.S_CURVE)
        for widget in (self._table_title, self.table):
            widget.setVisible(shape == ThrustShape.TABLE)
        try:
            parse_table(self.table.toPlainText())
            problem = ""
        except ParameterInputError as error:
            problem = describe_error(error)
        self.table.setToolTip(make_tooltip(*_get_table_tooltip(), problem))

    def _show_more(self, is_shown: bool) -> None:
        self.more_button.setText(tr("Less ▾") if is_shown else tr("More ▸"))
        self._detection_fields.setVisible(is_shown)


def _get_table_tooltip() -> list[str]:
    return [tr(line) for line in _TABLE_TOOLTIP_LINES]
