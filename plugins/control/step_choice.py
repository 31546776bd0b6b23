"""The step of a stage's jog buttons: one choice for its lengths and one for its angles."""

from PySide6.QtWidgets import QComboBox, QHBoxLayout, QLabel, QWidget

from rotemina.app.display import step_presets
from rotemina.sim.robot.model import Robot
from rotemina.sim.units import symbol, to_unit


class StepChoice(QWidget):
    """Step presets of a stage, small first; the default moves a thousandth of the range or less."""

    def __init__(self, robot: Robot, axes: tuple[str, ...]) -> None:
        super().__init__()
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 2)
        row.addWidget(QLabel("Step"))
        self._boxes: dict[str, QComboBox] = {}
        self._quantities = {name: robot.axes[name].unit or "m" for name in axes}
        for quantity in dict.fromkeys(self._quantities.values()):
            spans = [robot.axes[n].span for n in axes if self._quantities[n] == quantity]
            box = _box(quantity, min(spans))
            self._boxes[quantity] = box
            row.addWidget(box, 1)

    def step(self, axis: str) -> float:
        """Return the chosen step of an axis, m or rad."""
        return float(self._boxes[self._quantities[axis]].currentData())


def _box(quantity: str, span: float) -> QComboBox:
    box = QComboBox()
    for step in step_presets(quantity, span):
        box.addItem(step_text(step, quantity), step)
        if step <= span / 1000:
            box.setCurrentIndex(box.count() - 1)
    box.setAccessibleName(f"Jog step, {'angles' if quantity == 'rad' else 'lengths'}")
    box.setToolTip("How far one press of + or − moves an axis")
    return box


def step_text(step: float, quantity: str) -> str:
    """Return a step in the unit that needs no decimals: ``10 nm``, ``1 µm``, ``1 mm``."""
    units = ("urad",) if quantity == "rad" else ("mm", "um", "nm")
    unit = next((u for u in units if float(to_unit(step, u)) > 0.999), units[-1])
    return f"{float(to_unit(step, unit)):g} {symbol(unit)}"
