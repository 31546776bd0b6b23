"""How far each axis is from where it was when the operator pressed *Zero here*."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFormLayout, QLabel, QPushButton
from rotemina.app.display_units import axis_scale, label
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import STALE_S, Area, Panel
from rotemina.app.shell.workbench import Level, Workbench


class DistancePanel(Panel):
    """Readings of all axes from a zero of their own, with their age where they are old."""

    title = "Distance"
    area = Area.RIGHT
    order = 500
    api_version = 1

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self._scales = {name: axis_scale(axis) for name, axis in workbench.robot.axes.items()}
        self._measured: dict[str, float] = {}
        self._zero: dict[str, float] = {}
        self.readouts = {name: QLabel("–") for name in self._scales}
        self.age = QLabel("no reading yet")
        self.zero_here = QPushButton("Zero here")
        self.zero_here.setToolTip("Tell from here on how far each axis is from where it is now")
        self.zero_here.clicked.connect(self.set_zero)
        form = QFormLayout(self)
        for name, readout in self.readouts.items():
            readout.setAlignment(Qt.AlignmentFlag.AlignRight)
            form.addRow(label(name), readout)
        form.addRow("Age", self.age)
        form.addRow(self.zero_here)
        workbench.shown.connect(self.refresh)  # once a frame, at most 30 a second

    def set_zero(self) -> None:
        """Take where the axes are as zero; nothing moves."""
        if not self._measured:
            self.workbench.notify(Level.WARNING, "Distance: there is no reading yet to start from")
            return
        self._zero = dict(self._measured)
        self._show_distances()

    def refresh(self, state: SessionState) -> None:
        """Show a state of what the window shows: the machine, or a replay."""
        self._measured = dict(state.measured)
        self._show_distances()
        if state.age_s is not None:
            self.age.setText(f"{state.age_s:.1f} s" if state.age_s > STALE_S else "fresh")

    def _show_distances(self) -> None:
        for name, position in self._measured.items():
            distance = position - self._zero.get(name, 0.0)
            self.readouts[name].setText(self._scales[name].text(distance))
