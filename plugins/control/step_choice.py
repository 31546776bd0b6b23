"""Choice of the jog step of a stage, and of the speed of all moves from this panel."""

from collections.abc import Iterable

from PySide6.QtWidgets import QLabel, QWidget

from rotemina.app.language import make_step_presets
from rotemina.app.widgets.controls import WheelSafeComboBox
from rotemina.app.widgets.layout import make_row
from rotemina.plugins.control import tr
from rotemina.sim.messages import format_rounded
from rotemina.sim.robot import Robot
from rotemina.sim.units import make_scale, to_unit

# The offered speeds, as fractions of the maximum speed of each axis.
SPEED_SHARES = (1.0, 0.5, 0.25, 0.1, 0.05, 0.01)


class StepChoice(QWidget):
    """Choice of the jog step of a stage: one list for lengths and one for angles.

    The steps are in increasing order. The default is the largest step of at most a thousandth of
    the range. The last entry is "hold": the axis moves while its button is held.
    """

    def __init__(self, robot: Robot, axes: tuple[str, ...]) -> None:
        super().__init__()
        row = make_row(QLabel(tr("Step")), on=self, margins=0, spacing=6)
        self.step_boxes: dict[str, WheelSafeComboBox] = {}
        self._quantities = {name: robot.axes[name].unit or "m" for name in axes}
        for quantity in dict.fromkeys(self._quantities.values()):
            spans = [robot.axes[name].span for name in axes if self._quantities[name] == quantity]
            box = _make_step_box(quantity, min(spans))
            self.step_boxes[quantity] = box
            row.addWidget(box)

    def find_step(self, axis: str) -> float | None:
        """Return the chosen step of an axis, m or rad, or None if "hold" is chosen."""
        step = self.step_boxes[self._quantities[axis]].currentData()
        return None if step is None else float(step)

    def choose_hold(self, quantity: str) -> None:
        """Choose "hold" for lengths (``quantity`` "m") or for angles ("rad")."""
        box = self.step_boxes[quantity]
        box.setCurrentIndex(box.count() - 1)


class SpeedChoice(WheelSafeComboBox):
    """Choice of the speed of jogs and moves, as a fraction of the maximum speed of each axis."""

    def __init__(self, robot: Robot) -> None:
        super().__init__(
            tr("Speed of moves"), tr("Speed of jogging and go-to, relative to the axis' maximum")
        )
        self._robot = robot
        for share in SPEED_SHARES:
            self.addItem(f"{format_rounded(100 * share, 6)} %", share)

    @property
    def fraction(self) -> float:
        """The chosen fraction of the maximum speed, 0 to 1."""
        return float(self.currentData())

    def choose_fraction(self, share: float) -> None:
        """Choose a fraction of the maximum speed. A fraction that is not offered is ignored."""
        if (index := self.findData(share)) >= 0:
            self.setCurrentIndex(index)

    def find_speed_limits(self, axes: Iterable[str]) -> dict[str, float]:
        """Return the speed limits of the axes, m/s or rad/s; empty if full speed is chosen."""
        share = self.fraction
        return {} if share == 1.0 else dict(self._compute_speeds(axes, share))

    def find_hold_speed(self, axis: str) -> float | None:
        """Return the speed of an axis while its button is held, m/s or rad/s.

        Return None if the robot file states no maximum speed.
        """
        return dict(self._compute_speeds((axis,), self.fraction)).get(axis)

    def _compute_speeds(self, axes: Iterable[str], share: float) -> Iterable[tuple[str, float]]:
        for axis in axes:
            max_speed = self._robot.axes[axis].max_speed
            if max_speed is not None:
                yield axis, share * max_speed


def _make_step_box(quantity: str, span: float) -> WheelSafeComboBox:
    kind = tr("angles") if quantity == "rad" else tr("lengths")
    box = WheelSafeComboBox(
        tr("Jog step, {kind}").format(kind=kind),
        tr("Distance of one press of + or − ({kind}); hold: while the button is pressed").format(
            kind=kind
        ),
    )
    for step in make_step_presets(quantity, span):
        box.addItem(format_step(step, quantity), step)
        if step <= span / 1000:
            box.setCurrentIndex(box.count() - 1)
    box.addItem(tr("hold"), None)
    return box


def format_step(step: float, quantity: str) -> str:
    """Return a step as text in a unit that needs no decimals: ``10 nm``, ``1 µm``, ``1 mm``."""
    units = ("urad",) if quantity == "rad" else ("mm", "um", "nm")
    unit = next((name for name in units if float(to_unit(step, name)) > 0.999), units[-1])
    return make_scale(unit).format_with_unit(step)
