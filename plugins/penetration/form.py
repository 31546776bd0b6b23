"""The parameters of a penetration as a form; typing in it moves nothing."""

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

from rotemina.app.display_units import label
from rotemina.app.motion.penetration.parameters import (
    Direction,
    PenetrationParameters,
    Shaping,
    ThrustShape,
)
from rotemina.app.shell.engine_words import error_text, spoken
from rotemina.app.widgets.controls import allow, plain_tip
from rotemina.app.widgets.labels import heading
from rotemina.app.widgets.layouts import in_column, in_grid, in_row
from rotemina.app.widgets.scroll_areas import FittedScroll
from rotemina.app.widgets.wheel_safe import SteadyChoice
from rotemina.plugins.penetration import mark, tr
from rotemina.plugins.penetration.form_fields import NumberField
from rotemina.plugins.penetration.parameter_quantities import (
    QUANTITIES,
    Group,
    TypedError,
    in_group,
)
from rotemina.plugins.penetration.thrust_table_text import EXAMPLE, read_table, table_text
from rotemina.sim.errors import InputError
from rotemina.sim.robot.model import Robot

_SHAPES = {
    ThrustShape.S_CURVE: mark("S-curve"),
    ThrustShape.MINIMUM_JERK: mark("minimum jerk"),
    ThrustShape.TABLE: mark("table"),
}
_SHAPINGS = {
    Shaping.NONE: mark("none"),
    Shaping.ZV: mark("ZV"),
    Shaping.ZVD: mark("ZVD"),
    Shaping.ZVDD: mark("ZVDD"),
    Shaping.INVERSE: mark("inverse model"),
}
_TABLE_TIP = (
    mark("Points of the thrust, one per line: time share, depth share."),
    mark("From 0, 0 to 1, 1; 2 to 200 points."),
)


class ParameterForm(FittedScroll):
    """Fields by group; what they hold is taken when a field is left or Enter is pressed.

    Signals
    -------
    changed() : ``parameters`` or ``complaint`` did.
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
        self.fields = {key: NumberField(one, self) for key, one in QUANTITIES.items()}
        self._make_choices(robot)
        self._make_more()
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
            if choice.findData(value) < 0:  # an axis of another robot
                choice.addItem(value, value)
            choice.select(value)
        self.table.blockSignals(True)
        self.table.setPlainText(table_text(parameters.table or EXAMPLE))
        self.table.blockSignals(False)
        self._show_what_counts()

    def take(self) -> None:
        """Read every field; also one that is still being edited."""
        before = self.parameters, self.complaint
        wrong = [field.complaint() for field in self.fields.values()]
        self.complaint = next((one for one in wrong if one is not None), "")
        if not self.complaint:
            try:
                self.parameters = self._read()
            except InputError as error:
                self.complaint = error_text(error)
        self._show_what_counts()
        if (self.parameters, self.complaint) != before:
            self.changed.emit()

    def allow(self, why_not: str | None) -> None:
        """Let the fields be changed, or say why not; they can be read all the same."""
        allow(self._body, why_not, "")
        allow(self.load, why_not, tr("Replace these parameters by those of a TOML file"))

    # --- parts ------------------------------------------------------------------------------------

    def _lay_out(self) -> None:
        in_column(*(self._section(group) for group in Group), on=self._body, margins=0, spacing=2)
        files = in_row((self.load, 1), (self.save, 1), spacing=6)
        content = QWidget()
        in_column(self._body, files, 1, on=content, margins=(0, 0, 8, 4))
        self.setWidget(content)

    def _make_choices(self, robot: Robot) -> None:
        axis = SteadyChoice(
            tr("Axis of the penetration"), tr("Axis that penetrates the cell"), letters=8
        )
        for name in robot.axes:
            if robot.unit(name) == "m":
                axis.addItem(label(name), name)
        direction = SteadyChoice(
            tr("Direction"),
            tr("Direction of the cell along the axis; down: towards smaller positions"),
            letters=8,
        )
        shape = SteadyChoice(
            tr("Shape of the thrust"), tr("Speed profile of the thrust"), letters=8
        )
        shaping = SteadyChoice(
            tr("Input shaping"),
            tr(
                "Suppresses the resonance of the axis in the robot file. ZV, ZVD, ZVDD: "
                "impulses, increasingly slow and robust; inverse model: best tracking"
            ),
            letters=8,
        )
        for direct in Direction:
            direction.addItem(spoken(direct), str(direct))
        for form, text in _SHAPES.items():
            shape.addItem(tr(text), str(form))
        for kind, text in _SHAPINGS.items():
            shaping.addItem(tr(text), str(kind))
        self.choices = {"axis": axis, "direction": direction, "shape": shape, "shaping": shaping}
        self.table = QPlainTextEdit()
        self.table.setAccessibleName(tr("Table of the thrust: time share, depth share"))
        self.table.setToolTip(plain_tip(*_table_tip()))
        self.table.setTabChangesFocus(True)
        self.table.setFixedHeight(86)

    def _make_more(self) -> None:
        self.more = QToolButton()
        self.more.setText(tr("More ▸"))
        self.more.setCheckable(True)
        self.more.setAccessibleName(tr("More settings of the contact detection"))
        self.more.setToolTip(
            tr("Settings that distinguish contact from noise, hysteresis and creep")
        )
        self._detection = QWidget()
        self._detection.hide()

    def _section(self, group: Group) -> QWidget:
        section, body = QWidget(), QWidget()
        column = in_column(on=section, margins=(0, 0, 0, 2), spacing=2)
        column.addWidget(heading(tr(group)))
        if group is Group.CONTACT:
            body = self._detection
            column.addWidget(self.more, 0, Qt.AlignmentFlag.AlignLeft)
        column.addWidget(body)
        grid = in_grid(on=body, margins=0, spacing=(8, 3), stretched=0)
        if group is Group.APPROACH:
            self._add_choice(grid, tr("Axis"), "axis")
            self._add_choice(grid, tr("Cell is"), "direction")
        if group is Group.THRUST:
            self._add_choice(grid, tr("Shape"), "shape")
            self._add_choice(grid, tr("Shaping"), "shaping")
        for quantity in in_group(group):
            field, row = self.fields[quantity.key], grid.rowCount()
            for place, widget in enumerate((field.title, field.edit, field.unit)):
                grid.addWidget(widget, row, place)
        if group is Group.THRUST:
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
            field.changed.connect(self.take)
        for choice in self.choices.values():
            choice.activated.connect(lambda _: self.take())
        self.table.textChanged.connect(self.take)
        self.more.toggled.connect(self._show_more)

    # --- inside -----------------------------------------------------------------------------------

    def _read(self) -> PenetrationParameters:
        asked: dict[str, Any] = {key: field.value for key, field in self.fields.items()}
        asked |= {key: choice.currentData() for key, choice in self.choices.items()}
        tabled = asked["shape"] == ThrustShape.TABLE
        asked["table"] = read_table(self.table.toPlainText()) if tabled else ()
        return PenetrationParameters(**asked)

    def _show_what_counts(self) -> None:
        shape = self.choices["shape"].currentData()
        self.fields["ramp"].set_visible(shape == ThrustShape.S_CURVE)
        for widget in (self._table_title, self.table):
            widget.setVisible(shape == ThrustShape.TABLE)
        try:
            read_table(self.table.toPlainText())
            wrong = ""
        except TypedError as error:
            wrong = error_text(error)
        self.table.setToolTip(plain_tip(*_table_tip(), wrong))

    def _show_more(self, shown: bool) -> None:
        self.more.setText(tr("Less ▾") if shown else tr("More ▸"))
        self._detection.setVisible(shown)


def _table_tip() -> list[str]:
    return [tr(line) for line in _TABLE_TIP]
