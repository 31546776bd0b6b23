"""The jog step of a stage, and the speed of all moves from this menu."""

from collections.abc import Iterable

from PySide6.QtWidgets import QLabel, QWidget

from rotemina.app.display_units import step_presets
from rotemina.app.widgets.layouts import in_row
from rotemina.app.widgets.wheel_safe import SteadyChoice
from rotemina.plugins.control import tr
from rotemina.sim.quantities import rounded, scale_in
from rotemina.sim.robot.model import Robot
from rotemina.sim.units import to_unit

SPEEDS = (1.0, 0.5, 0.25, 0.1, 0.05, 0.01)  # of an axis' greatest speed


class StepChoice(QWidget):
    """Step presets of a stage, small first, one choice for its lengths and one for its angles.

    The default moves a thousandth of the range or less. Behind the steps stands "hold": the axis
    goes while its button is held.
    """

    def __init__(self, robot: Robot, axes: tuple[str, ...]) -> None:
        super().__init__()
        row = in_row(QLabel(tr("Step")), on=self, margins=0, spacing=6)
        self.boxes: dict[str, SteadyChoice] = {}
        self._quantities = {name: robot.axes[name].unit or "m" for name in axes}
        for quantity in dict.fromkeys(self._quantities.values()):
            spans = [robot.axes[n].span for n in axes if self._quantities[n] == quantity]
            box = _box(quantity, min(spans))
            self.boxes[quantity] = box
            row.addWidget(box)

    def step(self, axis: str) -> float | None:
        """Return the chosen step of an axis, m or rad; None: it goes while its button is held."""
        chosen = self.boxes[self._quantities[axis]].currentData()
        return None if chosen is None else float(chosen)

    def hold(self, quantity: str) -> None:
        """Choose "hold" for lengths (``m``) or angles (``rad``)."""
        box = self.boxes[quantity]
        box.setCurrentIndex(box.count() - 1)


class SpeedChoice(SteadyChoice):
    """The share of each axis' greatest speed that jog and go-to use."""

    def __init__(self, robot: Robot) -> None:
        super().__init__(
            tr("Speed of moves"), tr("Speed of jogging and go-to, relative to the axis' maximum")
        )
        self._robot = robot
        for share in SPEEDS:
            self.addItem(f"{rounded(100 * share, 6)} %", share)

    @property
    def share(self) -> float:
        """The share, 0 to 1."""
        return float(self.currentData())

    def choose(self, share: float) -> None:
        """Choose a share; another one than those offered is left out."""
        if (index := self.findData(share)) >= 0:
            self.setCurrentIndex(index)

    def speeds(self, axes: Iterable[str]) -> dict[str, float]:
        """Return the bounds on the axes' speeds, m/s or rad/s; none at full speed."""
        share = self.share
        return {} if share == 1.0 else dict(self._of(axes, share))

    def speed(self, axis: str) -> float | None:
        """Return how fast an axis goes while its button is held; None if it has no bound."""
        return dict(self._of((axis,), self.share)).get(axis)

    def _of(self, axes: Iterable[str], share: float) -> Iterable[tuple[str, float]]:
        for axis in axes:
            most = self._robot.axes[axis].max_speed
            if most is not None:
                yield axis, share * most


def _box(quantity: str, span: float) -> SteadyChoice:
    kind = tr("angles") if quantity == "rad" else tr("lengths")
    box = SteadyChoice(
        tr("Jog step, {kind}").format(kind=kind),
        tr("Distance of one press of + or − ({kind}); hold: while the button is pressed").format(
            kind=kind
        ),
    )
    for step in step_presets(quantity, span):
        box.addItem(step_text(step, quantity), step)
        if step <= span / 1000:
            box.setCurrentIndex(box.count() - 1)
    box.addItem(tr("hold"), None)
    return box


def step_text(step: float, quantity: str) -> str:
    """Return a step in the unit that needs no decimals: ``10 nm``, ``1 µm``, ``1 mm``."""
    units = ("urad",) if quantity == "rad" else ("mm", "um", "nm")
    unit = next((u for u in units if float(to_unit(step, u)) > 0.999), units[-1])
    return scale_in(unit).text(step)
