"""Plot of the gap of one record over time, before and after the correction."""

from collections.abc import Sequence
from html import escape

import numpy as np
from PySide6.QtWidgets import QComboBox, QLabel, QWidget

from rotemina.app.widgets.controls import name_widget
from rotemina.app.widgets.drawing import LineStyle, SignalPlot
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.style import Theme
from rotemina.plugins.gap import tr
from rotemina.sim.gap.output import GapTrace
from rotemina.sim.units import choose_scale

# Names of the curves, and the roles whose colours they have in the theme.
FLOOR_CURVES = {"floor above": "good", "floor below": "good"}


class TraceView(QWidget):
    """Plot of one trace, with a box that selects the trace. Two lines show the noise floor."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.choice = name_widget(QComboBox(), tr("Record and signal"), tr("Record and channel"))
        policy = QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
        self.choice.setSizeAdjustPolicy(policy)
        self.choice.setMinimumContentsLength(14)
        self.choice.activated.connect(lambda _: self._draw())
        self.title = QLabel()
        self.plot = SignalPlot(theme)
        for name, role in (*FLOOR_CURVES.items(), ("before", "command"), ("after", "model")):
            self.plot.add_curve(name, LineStyle(role))
        self.plot.show_times(True)
        header = make_row(self.choice, (self.title, 1))
        make_column(header, (self.plot, 1), on=self, margins=(4, 0, 0, 0), spacing=2)

    def show_traces(self, named_traces: Sequence[tuple[str, GapTrace]], chosen: int = 0) -> None:
        """Offer traces by name, and draw the one with the index ``chosen``."""
        self.choice.clear()
        for name, trace in named_traces:
            self.choice.addItem(name, trace)
        self.choice.setCurrentIndex(chosen if named_traces else -1)
        self._draw()

    def choose(self, row: int) -> None:
        """Draw another of the traces."""
        self.choice.setCurrentIndex(row)
        self._draw()

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self.plot.set_theme(theme)
        self._draw()

    def _draw(self) -> None:
        trace: GapTrace | None = self.choice.currentData()
        for name in (*FLOOR_CURVES, "before", "after"):
            self.plot.clear_signal(name)
        if trace is None:
            self.title.clear()
            return
        scale = choose_scale(trace.unit, float(np.abs(trace.gap_before).max()))
        theme = self._theme
        text = tr(
            'gap [{unit}]: <span style="color:{command}">before</span>, '
            '<span style="color:{good}">noise floor</span>'
        )
        if trace.is_corrected:
            text = tr(
                'gap [{unit}]: <span style="color:{command}">before</span>, '
                '<span style="color:{model}">after</span>, '
                '<span style="color:{good}">noise floor</span>'
            )
        self.title.setText(
            text.format(
                unit=escape(scale.symbol), command=theme.command, model=theme.model, good=theme.good
            )
        )
        time_s = trace.time_s
        self.plot.show_signal("before", time_s, scale(trace.gap_before))
        if trace.is_corrected:
            self.plot.show_signal("after", time_s, scale(trace.gap_after))
        for name, sign in zip(FLOOR_CURVES, (1.0, -1.0), strict=True):
            floor = np.full(2, sign * trace.floor)
            self.plot.show_signal(name, time_s[[0, -1]], scale(floor))
        self.plot.set_time_span(0.0, max(float(time_s[-1]), 1e-9))
        self.plot.enableAutoRange(axis="y")
