"""Demonstration cell in the simulator: place it ahead of the tip, or remove it."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QLineEdit, QPushButton, QWidget

from rotemina.app.errors import PenetrationError
from rotemina.app.language import get_axis_label
from rotemina.app.motion.penetration import PenetrationParameters
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import (
    enable_unless,
    make_tooltip,
    name_widget,
    set_property,
)
from rotemina.app.widgets.layout import make_column, make_grid
from rotemina.app.widgets.text import make_plain_label
from rotemina.app.workbench import Workbench
from rotemina.plugins.penetration import mark, tr
from rotemina.plugins.penetration.parameter_quantities import ParameterInputError
from rotemina.plugins.penetration.plan_preview import format_distance
from rotemina.sim.effects import AttachedEffect
from rotemina.sim.messages import format_rounded, parse_number
from rotemina.sim.robot import AxisEffect, Robot

REAL_MACHINE_TEXT = mark(
    "Demonstration cells exist only in the simulator. On a real machine put a "
    "real cell under the tip."
)
_MEMBRANE_TEXT = mark(
    "Elastic membrane (effect “contact”); other effects stay. The membrane does"
    " not break: remove it during the thrust to simulate a rupture."
)


AxisEffects = tuple[AxisEffect, ...]

CONTACT_ID = "contact"
#: Default distance ahead of the tip, m, and default stiffness relative to the axis.
DEFAULT_DISTANCE_M, DEFAULT_STIFFNESS_RATIO = 5e-6, 0.1


def with_cell(
    robot: Robot,
    effects: AxisEffects,
    axis: str,
    contact_position: float,
    sign: float,
    stiffness: float,
) -> AxisEffects:
    """Return effects with exactly one cell on an axis. All other effects are kept.

    Parameters
    ----------
    contact_position : float
        Position of the axis at which the tip touches the cell, m.
    sign : float
        Direction of the tip at the contact, −1 or 1.
    stiffness : float
        Stiffness of the cell relative to that of the axis.

    Raises
    ------
    PenetrationError
        If the cell would be outside the range of the axis.
    EffectError
        If the effect does not accept the values.
    """
    low, _ = robot.axes[axis].range
    default_cell = AttachedEffect.of(robot, AxisEffect(axis=axis, id=CONTACT_ID))
    place, parameter = contact_position - low, default_cell.formulation.find_parameter("place")
    assert parameter is not None, "every contact has a place"
    min_place, max_place = parameter.bounds(default_cell.facts)
    if not min_place <= place <= max_place:
        raise PenetrationError(
            tr(
                "a cell at {at} of {axis} must be within {least} to {most}; move the axis "
                "away from its end first"
            ).format(
                at=format_distance(contact_position),
                axis=get_axis_label(axis),
                least=format_distance(low + min_place),
                most=format_distance(low + max_place),
            )
        )
    values = {"place": place, "stiffness": sign * stiffness}
    cell = AxisEffect(axis=axis, id=CONTACT_ID, parameters=values)
    AttachedEffect.of(robot, cell)
    return (*without_cell(effects, axis), cell)


def without_cell(effects: AxisEffects, axis: str) -> AxisEffects:
    """Return effects without the cells on an axis."""
    return tuple(effect for effect in effects if not _is_cell(effect, axis))


def describe_cells(robot: Robot, effects: AxisEffects, axis: str) -> str:
    """Return the positions of the cells on an axis as text."""
    low, _ = robot.axes[axis].range
    cell_texts = []
    for effect in effects:
        if _is_cell(effect, axis) and effect.enabled:
            values = AttachedEffect.of(robot, effect).values
            cell_texts.append(
                tr("{at} of {axis}").format(
                    at=format_distance(low + values["place"]), axis=get_axis_label(axis)
                )
            )
    return (
        tr("A cell at {places}.").format(places=tr(" and ").join(cell_texts))
        if cell_texts
        else tr("There is no cell.")
    )


def _is_cell(effect: AxisEffect, axis: str) -> bool:
    return effect.id == CONTACT_ID and effect.axis == axis


class SimulatedCellView(QWidget):
    """View of the simulated cell: its position, and buttons to place or remove it."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self._parameters = PenetrationParameters()
        self._shown_inputs: object = ()
        #: Whether a simulator without a cell is in use.
        self.is_missing = False
        self.place_label, self.hint_label = make_plain_label(wrap=True), make_plain_label(wrap=True)
        self.place_label.setProperty("quiet", False)
        distance_tooltip = tr("Distance from the present position of the axis, above 0 µm")
        self.ahead = _make_field(
            format_rounded(1e6 * DEFAULT_DISTANCE_M),
            tr("Distance to the cell, µm"),
            distance_tooltip,
        )
        self.stiffness = _make_field(
            format_rounded(DEFAULT_STIFFNESS_RATIO),
            tr("Stiffness of the cell"),
            tr("Relative to the stiffness of the axis, up to 30"),
        )
        self.place_button, self.remove_button = (
            QPushButton(tr("Place cell")),
            QPushButton(tr("Remove")),
        )
        self.place_button.clicked.connect(lambda _: self._place_cell())
        self.remove_button.clicked.connect(lambda _: self._remove_cell())
        self.controls = QWidget()
        grid = make_grid(on=self.controls, margins=0, stretched=4)
        grid.addWidget(QLabel(tr("Ahead of the tip")), 0, 0)
        grid.addWidget(self.ahead, 0, 1)
        grid.addWidget(QLabel("µm"), 0, 2)
        grid.addWidget(QLabel(tr("Stiffness")), 1, 0)
        grid.addWidget(self.stiffness, 1, 1)
        grid.addWidget(QLabel(tr("× axis")), 1, 2)
        grid.addWidget(self.place_button, 0, 3)
        grid.addWidget(self.remove_button, 1, 3)
        make_column(
            self.place_label, self.controls, self.hint_label, 1, on=self, margins=(0, 4, 0, 0)
        )

    def refresh(self, state: SessionState, parameters: PenetrationParameters) -> None:
        """Show the cell for the axis and direction of the parameters."""
        session, self._parameters = self._workbench.session, parameters
        effects, axis = session.service.effects, parameters.axis
        if (effects, axis) != self._shown_inputs:
            self._shown_inputs = effects, axis
            is_simulated = effects is not None
            self.controls.setVisible(is_simulated)
            self.hint_label.setText(tr(_MEMBRANE_TEXT if is_simulated else REAL_MACHINE_TEXT))
            self.place_label.setVisible(is_simulated)
            if effects is not None and axis in session.robot.axes:
                self.place_label.setText(describe_cells(session.robot, effects, axis))
        position = state.measured.get(axis)
        objection = None if position is not None else tr("the axis' position is unknown")
        enable_unless(
            self.place_button,
            objection,
            tr("Place a cell ahead of the present position of the axis, or move it there"),
        )
        has_cell = effects is not None and without_cell(effects, axis) != effects
        self.is_missing = effects is not None and not has_cell
        enable_unless(
            self.remove_button,
            None if has_cell else tr("there is no cell"),
            tr("Remove the simulated cell"),
        )

    def _place_cell(self) -> None:
        session, parameters = self._workbench.session, self._parameters

        def place_cell() -> None:
            distance = _read_positive(self.ahead, tr("distance to the cell")) / 1e6
            stiffness = _read_positive(self.stiffness, tr("stiffness"))
            # The measured position is used. Hysteresis and creep shift it from the commanded one.
            axis_position = (
                session.snapshot().measured[parameters.axis]
                - session.robot.axes[parameters.axis].offset
            )
            position = axis_position + parameters.sign * distance
            effects = session.service.effects or ()
            session.service.set_effects(
                with_cell(
                    session.robot, effects, parameters.axis, position, parameters.sign, stiffness
                )
            )

        self._workbench.run_request(place_cell)

    def _remove_cell(self) -> None:
        session, axis = self._workbench.session, self._parameters.axis
        self._workbench.run_request(
            lambda: session.service.set_effects(without_cell(session.service.effects or (), axis))
        )


def _read_positive(field: QLineEdit, name: str) -> float:
    text = field.text().strip()
    number = parse_number(text)
    is_valid = number is not None and number > 0.0
    set_property(field, "bad", not is_valid)
    if number is None or not is_valid:
        raise ParameterInputError(
            tr("{name}: {text!r}; enter a number above 0 with a decimal point").format(
                name=name, text=text
            )
        )
    return number


def _make_field(text: str, name: str, tooltip: str) -> QLineEdit:
    field = name_widget(QLineEdit(text), name, make_tooltip(f"{name}. {tooltip}."))
    field.setFixedWidth(70)
    field.setAlignment(Qt.AlignmentFlag.AlignRight)
    return field
