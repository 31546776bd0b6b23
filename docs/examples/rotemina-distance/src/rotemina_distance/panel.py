"""Panel that shows the distance of each axis from its position at *Zero here*."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFormLayout, QLabel, QPushButton
from rotemina.app.language import choose_axis_scale, get_axis_label
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import (
    STALE_AGE_S,
    Panel,
    PanelArea,
)
from rotemina.app.workbench import Level, Workbench


class DistancePanel(Panel):
    """Readings of all axes from a zero of their own, with their age where they are old."""

    title = "Distance"
    area = PanelArea.RIGHT
    order = 500
    api_version = 2

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self._scales = {
            name: choose_axis_scale(axis) for name, axis in workbench.robot.axes.items()
        }
        self._measured: dict[str, float] = {}
        self._zero: dict[str, float] = {}
        self.readouts = {name: QLabel("–") for name in self._scales}
        self.age = QLabel("no reading yet")
        self.zero_here = QPushButton("Zero here")
        self.zero_here.setToolTip("Show the distance of each axis from its present position")
        self.zero_here.clicked.connect(self.set_zero)
        form = QFormLayout(self)
        for name, readout in self.readouts.items():
            readout.setAlignment(Qt.AlignmentFlag.AlignRight)
            form.addRow(get_axis_label(name), readout)
        form.addRow("Age", self.age)
        form.addRow(self.zero_here)
        workbench.shown.connect(self.refresh)  # once a frame, at most 30 a second

    def set_zero(self) -> None:
        """Use the present positions as zero; nothing moves."""
        if not self._measured:
            self.workbench.notify(
                Level.WARNING, "Distance: no position has been read yet. Connect the machine first."
            )
            return
        self._zero = dict(self._measured)
        self._show_distances()

    def refresh(self, state: SessionState) -> None:
        """Show a state of the machine, or of the replay that the window shows."""
        self._measured = dict(state.measured)
        self._show_distances()
        if state.age_s is not None:
            self.age.setText(f"{state.age_s:.1f} s" if state.age_s > STALE_AGE_S else "fresh")

    def _show_distances(self) -> None:
        for name, position in self._measured.items():
            distance = position - self._zero.get(name, 0.0)
            self.readouts[name].setText(self._scales[name].format_with_unit(distance))
