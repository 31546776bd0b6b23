"""Plot of the thrust against time: desired, commanded and, after a run, measured."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QWidget

from rotemina.app.motion.penetration import ThrustPlan, ThrustTrace
from rotemina.app.widgets.controls import WheelSafeComboBox, make_tooltip
from rotemina.app.widgets.drawing import LINE_STYLES, SignalPlot
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.style import Theme
from rotemina.app.widgets.text import make_colour_legend
from rotemina.plugins.penetration import mark, tr
from rotemina.plugins.penetration.plan_preview import (
    ThrustCurve,
    compute_shown_span,
    make_commanded_curve,
    make_desired_curve,
    make_measured_curve,
)

POSITION, SPEED = "position", "speed"
_CURVE_ROLES = {mark("desired"): "text", mark("commanded"): "command", mark("measured"): "real"}
# Smallest range of the vertical axis, µm and µm/s.
_MIN_PLOT_SPANS = {POSITION: 0.1, SPEED: 1.0}


class ThrustView(QWidget):
    """Plot of a thrust with a choice between position and speed."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.curves: dict[str, ThrustCurve] = {}
        self._plan: ThrustPlan | None = None
        self.plot = SignalPlot(theme)
        self.plot.add_curve("desired", LINE_STYLES["reference"])
        self.plot.add_curve("commanded", LINE_STYLES["command"])
        self.plot.add_curve("measured", LINE_STYLES["measured"])
        self.plot.show_times(True)
        self.plot.getPlotItem().getAxis("bottom").setLabel(tr("time [ms]"))
        self.plot.setMinimumSize(180, 80)
        self.plot.setAccessibleName(tr("Thrust over time"))
        self.plot.setToolTip(
            make_tooltip(
                tr(
                    "Desired: planned motion of the tip. Commanded: output of the device. "
                    "Measured: latest run, constant delay removed."
                )
            )
        )
        self.quantity_choice = WheelSafeComboBox(
            tr("Quantity of the plot"), tr("Distance into the cell, or speed"), letters=8
        )
        self.quantity_choice.addItem(tr("Position [µm]"), POSITION)
        self.quantity_choice.addItem(tr("Speed [µm/s]"), SPEED)
        self.quantity_choice.currentIndexChanged.connect(lambda _: self._draw_curves())
        self._legend = QLabel()
        self._legend.setTextFormat(Qt.TextFormat.RichText)
        self._legend.setWordWrap(True)
        self._legend.setMinimumWidth(100)
        head_row = make_row((self._legend, 1), self.quantity_choice, spacing=6)
        make_column(head_row, (self.plot, 1), on=self, margins=0, spacing=2)
        self.set_theme(theme)

    def show_plan(self, plan: ThrustPlan | None, trace: ThrustTrace | None) -> None:
        """Draw a planned thrust and, unless ``trace`` is None, the measured one."""
        self._plan, self.curves = plan, {}
        if plan is not None:
            self.curves = {
                "desired": make_desired_curve(plan),
                "commanded": make_commanded_curve(plan),
            }
        if plan is not None and trace is not None:
            self.curves["measured"] = make_measured_curve(trace)
        self._draw_curves()

    def set_theme(self, theme: Theme) -> None:
        """Use the colours of a theme."""
        self.plot.set_theme(theme)
        legend_entries = ((tr(name), role) for name, role in _CURVE_ROLES.items())
        self._legend.setText(make_colour_legend(theme, legend_entries, mark="▬"))

    def _draw_curves(self) -> None:
        if self._plan is None:
            for name in _CURVE_ROLES:
                self.plot.clear_signal(name)
            return
        quantity = self.quantity_choice.currentData()
        begin_s, end_s = compute_shown_span(self._plan)
        self.plot.set_time_span(1e3 * begin_s, 1e3 * end_s)
        low, high = 0.0, 0.0
        for name in _CURVE_ROLES:
            curve = self.curves.get(name)
            if curve is None or not len(curve.time_s):
                self.plot.clear_signal(name)
                continue
            values = 1e6 * (curve.speed if quantity == SPEED else curve.depth)
            self.plot.show_signal(name, 1e3 * curve.time_s, values)
            low, high = min(low, float(values.min())), max(high, float(values.max()))
        self.plot.fit_scale(low, high, _MIN_PLOT_SPANS[quantity])
