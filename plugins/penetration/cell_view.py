"""A demonstration cell on the simulator: place it ahead of the tip, remove it."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QLineEdit, QPushButton, QWidget

from rotemina.app.display_units import label
from rotemina.app.motion.penetration.parameters import PenetrationError, PenetrationParameters
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import allow, named, plain_tip, set_property
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_column, in_grid
from rotemina.plugins.penetration import mark, tr
from rotemina.plugins.penetration.parameter_quantities import TypedError
from rotemina.plugins.penetration.plan_preview import way_text
from rotemina.sim.effects.attachment import Attached
from rotemina.sim.quantities import parsed, rounded
from rotemina.sim.robot.model import AxisEffect, Robot

REAL_MACHINE = mark(
    "Demonstration cells exist only in the simulator. On a real machine put a "
    "real cell under the tip."
)
_ABOUT = mark(
    "Elastic membrane (effect “contact”); other effects stay. The membrane does"
    " not break: remove it during the thrust to simulate a rupture."
)


Effects = tuple[AxisEffect, ...]

CONTACT = "contact"
#: Where a cell is put and how stiff it is beside the axis itself, unless told otherwise.
AHEAD, STIFFNESS = 5e-6, 0.1


def with_cell(
    robot: Robot, effects: Effects, axis: str, at: float, sign: float, stiffness: float
) -> Effects:
    """Return effects with one cell on an axis; others are kept, another cell there is moved.

    Parameters
    ----------
    at : float
        Position of the axis at which the tip meets it, m.
    sign : float
        Which way the tip goes then.
    stiffness : float
        Over the axis' own.

    Raises
    ------
    PenetrationError
        If it would not be within the axis' range.
    EffectError
        If the effect does not take such values.
    """
    low, _ = robot.axes[axis].range
    bare = Attached.of(robot, AxisEffect(axis=axis, id=CONTACT))
    place, parameter = at - low, bare.formulation.parameter("place")
    assert parameter is not None, "every contact is somewhere"
    least, most = parameter.bounds(bare.facts)
    if not least <= place <= most:
        raise PenetrationError(
            tr(
                "a cell at {at} of {axis} must be within {least} to {most}; move the axis "
                "away from its end first"
            ).format(
                at=way_text(at),
                axis=label(axis),
                least=way_text(low + least),
                most=way_text(low + most),
            )
        )
    values = {"place": place, "stiffness": sign * stiffness}
    asked = AxisEffect(axis=axis, id=CONTACT, parameters=values)
    Attached.of(robot, asked)
    return (*without_cell(effects, axis), asked)


def without_cell(effects: Effects, axis: str) -> Effects:
    """Return effects without the cells on an axis."""
    return tuple(one for one in effects if not _is_cell(one, axis))


def cells_text(robot: Robot, effects: Effects, axis: str) -> str:
    """Return where the cells on an axis are, in words."""
    low, _ = robot.axes[axis].range
    places = []
    for one in effects:
        if _is_cell(one, axis) and one.enabled:
            values = Attached.of(robot, one).values
            places.append(
                tr("{at} of {axis}").format(at=way_text(low + values["place"]), axis=label(axis))
            )
    return (
        tr("A cell at {places}.").format(places=tr(" and ").join(places))
        if places
        else tr("There is no cell.")
    )


def _is_cell(one: AxisEffect, axis: str) -> bool:
    return one.id == CONTACT and one.axis == axis


class CellView(QWidget):
    """Where the simulated cell is, and two buttons."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self._parameters = PenetrationParameters()
        self._known: object = ()
        #: Whether the simulator has no cell that could be penetrated.
        self.missing = False
        self.where, self.about = plain_text(wrap=True), plain_text(wrap=True)
        self.where.setProperty("quiet", False)
        about = tr("Distance from the present position of the axis, above 0 µm")
        self.ahead = _field(rounded(1e6 * AHEAD), tr("Distance to the cell, µm"), about)
        self.stiffness = _field(
            rounded(STIFFNESS),
            tr("Stiffness of the cell"),
            tr("Relative to the stiffness of the axis, up to 30"),
        )
        self.put, self.take = QPushButton(tr("Place cell")), QPushButton(tr("Remove"))
        self.put.clicked.connect(lambda _: self._put())
        self.take.clicked.connect(lambda _: self._take())
        self.controls = QWidget()
        grid = in_grid(on=self.controls, margins=0, stretched=4)
        grid.addWidget(QLabel(tr("Ahead of the tip")), 0, 0)
        grid.addWidget(self.ahead, 0, 1)
        grid.addWidget(QLabel("µm"), 0, 2)
        grid.addWidget(QLabel(tr("Stiffness")), 1, 0)
        grid.addWidget(self.stiffness, 1, 1)
        grid.addWidget(QLabel(tr("× axis")), 1, 2)
        grid.addWidget(self.put, 0, 3)
        grid.addWidget(self.take, 1, 3)
        in_column(self.where, self.controls, self.about, 1, on=self, margins=(0, 4, 0, 0))

    def refresh(self, state: SessionState, parameters: PenetrationParameters) -> None:
        """Show a state, for the axis and direction of some parameters."""
        session, self._parameters = self._workbench.session, parameters
        effects, axis = session.service.effects, parameters.axis
        if (effects, axis) != self._known:
            self._known = effects, axis
            simulated = effects is not None
            self.controls.setVisible(simulated)
            self.about.setText(tr(_ABOUT if simulated else REAL_MACHINE))
            self.where.setVisible(simulated)
            if effects is not None and axis in session.robot.axes:
                self.where.setText(cells_text(session.robot, effects, axis))
        at = state.measured.get(axis)
        why = None if at is not None else tr("the axis' position is unknown")
        allow(
            self.put,
            why,
            tr("Place a cell ahead of the present position of the axis, or move it there"),
        )
        has = effects is not None and without_cell(effects, axis) != effects
        self.missing = effects is not None and not has
        allow(self.take, None if has else tr("there is no cell"), tr("Remove the simulated cell"))

    def _put(self) -> None:
        session, p = self._workbench.session, self._parameters

        def put() -> None:
            ahead = _value(self.ahead, tr("distance to the cell")) / 1e6
            stiffness = _value(self.stiffness, tr("stiffness"))
            # Where the tip is, not where it was sent: hysteresis and creep part the two.
            tip = session.snapshot().measured[p.axis] - session.robot.axes[p.axis].offset
            at = tip + p.sign * ahead
            effects = session.service.effects or ()
            session.service.set_effects(
                with_cell(session.robot, effects, p.axis, at, p.sign, stiffness)
            )

        self._workbench.ask(put)

    def _take(self) -> None:
        session, axis = self._workbench.session, self._parameters.axis
        self._workbench.ask(
            lambda: session.service.set_effects(without_cell(session.service.effects or (), axis))
        )


def _value(field: QLineEdit, name: str) -> float:
    text = field.text().strip()
    number = parsed(text)
    good = number is not None and number > 0.0
    set_property(field, "bad", not good)
    if number is None or not good:
        raise TypedError(
            tr("{name}: {text!r}; enter a number above 0 with a decimal point").format(
                name=name, text=text
            )
        )
    return number


def _field(text: str, name: str, tip: str) -> QLineEdit:
    field = named(QLineEdit(text), name, plain_tip(f"{name}. {tip}."))
    field.setFixedWidth(70)
    field.setAlignment(Qt.AlignmentFlag.AlignRight)
    return field
