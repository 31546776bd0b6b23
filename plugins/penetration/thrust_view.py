"""The thrust over time: desired, commanded, and measured after a run."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QWidget

from rotemina.app.motion.penetration.thrust import ThrustPlan, ThrustTrace
from rotemina.app.shell.plot import LINES, SignalPlot
from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.controls import plain_tip
from rotemina.app.widgets.labels import legend
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.app.widgets.wheel_safe import SteadyChoice
from rotemina.plugins.penetration import mark, tr
from rotemina.plugins.penetration.plan_preview import (
    Curve,
    commanded_curve,
    measured_curve,
    span_s,
    wanted_curve,
)

POSITION, SPEED = "position", "speed"
_ROLES = {mark("desired"): "text", mark("commanded"): "command", mark("measured"): "real"}
_LEAST = {POSITION: 0.1, SPEED: 1.0}  # µm, µm/s


class ThrustPreview(QWidget):
    """A plot with a choice between position and speed."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.curves: dict[str, Curve] = {}
        self._plan: ThrustPlan | None = None
        self.plot = SignalPlot(theme)
        self.plot.add_curve("desired", LINES["reference"])
        self.plot.add_curve("commanded", LINES["command"])
        self.plot.add_curve("measured", LINES["measured"])
        self.plot.show_times(True)
        self.plot.getPlotItem().getAxis("bottom").setLabel(tr("time [ms]"))
        self.plot.setMinimumSize(180, 80)
        self.plot.setAccessibleName(tr("Thrust over time"))
        self.plot.setToolTip(
            plain_tip(
                tr(
                    "Desired: planned motion of the tip. Commanded: output of the device. "
                    "Measured: latest run, constant delay removed."
                )
            )
        )
        self.shown = SteadyChoice(
            tr("Quantity of the plot"), tr("Distance into the cell, or speed"), letters=8
        )
        self.shown.addItem(tr("Position [µm]"), POSITION)
        self.shown.addItem(tr("Speed [µm/s]"), SPEED)
        self.shown.currentIndexChanged.connect(lambda _: self._draw())
        self._legend = QLabel()
        self._legend.setTextFormat(Qt.TextFormat.RichText)
        self._legend.setWordWrap(True)
        self._legend.setMinimumWidth(100)
        head = in_row((self._legend, 1), self.shown, spacing=6)
        in_column(head, (self.plot, 1), on=self, margins=0, spacing=2)
        self.set_theme(theme)

    def show_plan(self, plan: ThrustPlan | None, trace: ThrustTrace | None) -> None:
        """Draw a thrust, and how the latest one went, if that was by the same parameters."""
        self._plan, self.curves = plan, {}
        if plan is not None:
            self.curves = {"desired": wanted_curve(plan), "commanded": commanded_curve(plan)}
        if plan is not None and trace is not None:
            self.curves["measured"] = measured_curve(trace)
        self._draw()

    def set_theme(self, theme: Theme) -> None:
        """Change the colours."""
        self.plot.set_theme(theme)
        named = ((tr(name), role) for name, role in _ROLES.items())
        self._legend.setText(legend(theme, named, mark="▬"))

    def _draw(self) -> None:
        if self._plan is None:
            for name in _ROLES:
                self.plot.clear_signal(name)
            return
        shown = self.shown.currentData()
        begin_s, end_s = span_s(self._plan)
        self.plot.set_time(1e3 * begin_s, 1e3 * end_s)
        low, high = 0.0, 0.0
        for name in _ROLES:
            curve = self.curves.get(name)
            if curve is None or not len(curve.time_s):
                self.plot.clear_signal(name)
                continue
            values = 1e6 * (curve.speed if shown == SPEED else curve.way)
            self.plot.show_signal(name, 1e3 * curve.time_s, values)
            low, high = min(low, float(values.min())), max(high, float(values.max()))
        self.plot.follow(low, high, _LEAST[shown])
