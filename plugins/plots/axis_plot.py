"""The live plot of one axis, with the size of its gap in words."""

from enum import StrEnum

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QHBoxLayout, QLabel, QVBoxLayout, QWidget

from rotemina.app.display import axis_scale, label
from rotemina.app.motion.history import LiveWindow
from rotemina.app.shell.plot import SignalPlot
from rotemina.app.shell.theme import Theme
from rotemina.app.shell.workbench import Workbench
from rotemina.sim.units import symbol, to_unit


class Shown(StrEnum):
    """What the plots draw."""

    POSITION = "position"
    GAP = "gap"


class AxisPlot(QWidget):
    """Command, model and measurement of one axis over the last seconds."""

    def __init__(self, workbench: Workbench, column: int, *, times: bool) -> None:
        super().__init__()
        name = tuple(workbench.robot.axes)[column]
        axis = workbench.robot.axes[name]
        self._column = column
        self._scale = axis_scale(axis)
        self._gap_unit = "urad" if axis.unit == "rad" else "um"
        floor = axis.sensor.noise_floor if axis.sensor else axis.span * 1e-5
        self._floor = floor or axis.span * 1e-6
        self._title = QLabel(label(name))
        self._title.setProperty("heading", True)
        self._title.setTextFormat(Qt.TextFormat.PlainText)
        self._unit = QLabel()
        self._unit.setProperty("quiet", True)
        self._gap = QLabel()
        self._gap.setProperty("quiet", True)
        self.plot = SignalPlot(workbench.theme)
        self.plot.add_curve("command", "command")
        self.plot.add_curve("model", "model", width=3)  # seen on both sides of the measured line
        self.plot.add_curve("measured", "real")
        self.plot.show_times(times)
        self.plot.setMinimumHeight(60)  # notices and the banner of a replay need room, too
        head = QHBoxLayout()
        head.setContentsMargins(4, 0, 4, 0)
        head.setSpacing(6)
        head.addWidget(self._title)
        head.addWidget(self._unit)
        head.addStretch(1)
        head.addWidget(self._gap)
        column_layout = QVBoxLayout(self)
        column_layout.setContentsMargins(0, 0, 0, 0)
        column_layout.setSpacing(1)
        column_layout.addLayout(head)
        column_layout.addWidget(self.plot, 1)

    def use_theme(self, theme: Theme) -> None:
        """Change the colours."""
        self.plot.set_theme(theme)

    def draw(self, window: LiveWindow, span_s: float, shown: Shown) -> None:
        """Draw a window of live data; time runs up to 0, the newest sample."""
        self.plot.set_time(-span_s, 0.0)
        if len(window.device_time_s) == 0:
            self._gap.setText("")
            for name in ("command", "model", "measured"):
                self.plot.clear_signal(name)
            return
        since = window.device_time_s - window.device_time_s[-1]
        model, measured = (s[:, self._column] for s in (window.model, window.measured))
        gap = measured - model
        self._gap.setText(
            f"gap rms {to_unit(np.sqrt(np.mean(gap**2)), self._gap_unit):.3g} "
            f"{symbol(self._gap_unit)}"
        )
        if shown is Shown.GAP:
            self._draw_gap(since, gap)
        else:
            self._draw_position(since, window.command[:, self._column], model, measured)

    def _draw_gap(self, since: np.ndarray, gap: np.ndarray) -> None:
        self._unit.setText(f"[{symbol(self._gap_unit)}]")
        values = to_unit(gap, self._gap_unit)
        self.plot.clear_signal("command")
        self.plot.clear_signal("model")
        self.plot.show_signal("measured", since, values)
        self._follow(self._gap_unit, values)

    def _draw_position(
        self, since: np.ndarray, command: np.ndarray, model: np.ndarray, measured: np.ndarray
    ) -> None:
        self._unit.setText(f"[{self._scale.symbol}]")
        signals = {
            name: to_unit(values, self._scale.unit)
            for name, values in (("measured", measured), ("command", command), ("model", model))
        }
        for name, values in signals.items():
            self.plot.show_signal(name, since, values)
        self._follow(self._scale.unit, *signals.values())

    def _follow(self, unit: str, *signals: np.ndarray) -> None:
        low = min(float(values.min()) for values in signals)
        high = max(float(values.max()) for values in signals)
        self.plot.follow(low, high, 8.0 * float(to_unit(self._floor, unit)))
