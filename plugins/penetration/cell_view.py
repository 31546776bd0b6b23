"""A cell for demonstrations on the simulator: put it ahead of the tip, take it away."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QGridLayout, QLabel, QLineEdit, QPushButton, QVBoxLayout, QWidget

from rotemina.app.display import PLAIN_NUMBER
from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.controls import allow, plain_tip
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.workbench import Workbench
from rotemina.plugins.penetration.cells import (
    AHEAD,
    STIFFNESS,
    cells_text,
    with_cell,
    without_cell,
)
from rotemina.plugins.penetration.fields import mark
from rotemina.plugins.penetration.quantities import TypedError

REAL_MACHINE = marked(
    "penetration",
    "Cells for demonstrations belong to the simulator. On a real machine put a real one under the "
    "tip.",
)
_ABOUT = marked(
    "penetration",
    "An elastic membrane, the effect “contact”; the other effects stay. It does not break: take it "
    "away during the thrust to let it give way.",
)


class CellView(QWidget):
    """Where the simulated cell is, and two buttons."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self._parameters = PenetrationParameters()
        self._known: object = ()
        self.where, self.about = _text(), _text()
        self.where.setProperty("quiet", False)
        about = translate("penetration", "From where the axis stands, above 0 µm")
        self.ahead = _field(
            f"{1e6 * AHEAD:g}", translate("penetration", "Way to the cell, µm"), about
        )
        self.stiffness = _field(
            f"{STIFFNESS:g}",
            translate("penetration", "Stiffness of the cell"),
            translate("penetration", "Over that of the axis itself, up to 30"),
        )
        self.put, self.take = (
            QPushButton(translate("penetration", "Put a cell there")),
            QPushButton(translate("penetration", "Take it away")),
        )
        self.put.clicked.connect(lambda _: self._put())
        self.take.clicked.connect(lambda _: self._take())
        self.controls = QWidget()
        grid = QGridLayout(self.controls)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setColumnStretch(4, 1)
        grid.addWidget(QLabel(translate("penetration", "Ahead of the tip")), 0, 0)
        grid.addWidget(self.ahead, 0, 1)
        grid.addWidget(QLabel("µm"), 0, 2)
        grid.addWidget(QLabel(translate("penetration", "Stiffness")), 1, 0)
        grid.addWidget(self.stiffness, 1, 1)
        grid.addWidget(QLabel(translate("penetration", "× the axis'")), 1, 2)
        grid.addWidget(self.put, 0, 3)
        grid.addWidget(self.take, 1, 3)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 4, 0, 0)
        for widget in (self.where, self.controls, self.about):
            column.addWidget(widget)
        column.addStretch(1)

    def refresh(self, state: SessionState, parameters: PenetrationParameters) -> None:
        """Show a state, for the axis and direction of some parameters."""
        session, self._parameters = self._workbench.session, parameters
        effects, axis = session.effects, parameters.axis
        if (effects, axis) != self._known:
            self._known = effects, axis
            simulated = effects is not None
            self.controls.setVisible(simulated)
            self.about.setText(translate("penetration", _ABOUT if simulated else REAL_MACHINE))
            self.where.setVisible(simulated)
            if effects is not None and axis in session.robot.axes:
                self.where.setText(cells_text(session.robot, effects, axis))
        at = state.command.get(axis)
        why = None if at is not None else translate("penetration", "nobody knows where the axis is")
        allow(
            self.put,
            why,
            translate("penetration", "Put a cell ahead of where the axis is now, or move it there"),
        )
        has = effects is not None and without_cell(effects, axis) != effects
        allow(
            self.take,
            None if has else translate("penetration", "there is none"),
            translate("penetration", "Let the tip meet nothing any more"),
        )

    def _put(self) -> None:
        session, p = self._workbench.session, self._parameters

        def put() -> None:
            ahead = _value(self.ahead, translate("penetration", "way to the cell")) / 1e6
            stiffness = _value(self.stiffness, translate("penetration", "stiffness"))
            at = session.snapshot().command[p.axis] + p.sign * ahead
            effects = session.effects or ()
            session.set_effects(with_cell(session.robot, effects, p.axis, at, p.sign, stiffness))

        self._workbench.ask(put)

    def _take(self) -> None:
        session, axis = self._workbench.session, self._parameters.axis
        self._workbench.ask(lambda: session.set_effects(without_cell(session.effects or (), axis)))


def _value(field: QLineEdit, name: str) -> float:
    text = field.text().strip()
    good = PLAIN_NUMBER.fullmatch(text) is not None and float(text) > 0.0
    mark(field, not good)
    if not good:
        raise TypedError(
            translate(
                "penetration", "{name}: {text!r}; type a number above 0, with a decimal point"
            ).format(name=name, text=text)
        )
    return float(text)


def _field(text: str, name: str, tip: str) -> QLineEdit:
    field = QLineEdit(text)
    field.setFixedWidth(70)
    field.setAlignment(Qt.AlignmentFlag.AlignRight)
    field.setAccessibleName(name)
    field.setToolTip(plain_tip(f"{name}. {tip}."))
    return field


def _text() -> QLabel:
    label = QLabel()
    label.setProperty("quiet", True)
    label.setWordWrap(True)
    label.setTextFormat(Qt.TextFormat.PlainText)
    return label
