"""The gap of one record before and after, over time, between the lines of the noise floor."""

from collections.abc import Sequence
from html import escape

import numpy as np
from PySide6.QtWidgets import QComboBox, QLabel, QWidget

from rotemina.app.shell.plot import Line, SignalPlot
from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.controls import named
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.plugins.gap import tr
from rotemina.sim.gap.output.report.traces import Trace
from rotemina.sim.quantities import scale_of

FLOOR = (("floor above", "good"), ("floor below", "good"))


class TraceView(QWidget):
    """A choice of traces, and the plot of the chosen one."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.choice = named(QComboBox(), tr("Record and signal"), tr("Record and channel"))
        policy = QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
        self.choice.setSizeAdjustPolicy(policy)
        self.choice.setMinimumContentsLength(14)
        self.choice.activated.connect(lambda _: self._draw())
        self.title = QLabel()
        self.plot = SignalPlot(theme)
        for name, role in (*FLOOR, ("before", "command"), ("after", "model")):
            self.plot.add_curve(name, Line(role))
        self.plot.show_times(True)
        head = in_row(self.choice, (self.title, 1))
        in_column(head, (self.plot, 1), on=self, margins=(4, 0, 0, 0), spacing=2)

    def show_traces(self, named: Sequence[tuple[str, Trace]], chosen: int = 0) -> None:
        """Offer traces by their names, and draw one of them."""
        self.choice.clear()
        for name, trace in named:
            self.choice.addItem(name, trace)
        self.choice.setCurrentIndex(chosen if named else -1)
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
        trace: Trace | None = self.choice.currentData()
        for name in (*dict(FLOOR), "before", "after"):
            self.plot.clear_signal(name)
        if trace is None:
            self.title.clear()
            return
        scale = scale_of(trace.unit, float(np.abs(trace.before).max()))
        theme = self._theme
        text = tr(
            'gap [{unit}]: <span style="color:{command}">before</span>, '
            '<span style="color:{good}">noise floor</span>'
        )
        if trace.changed:
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
        self.plot.show_signal("before", time_s, scale(trace.before))
        if trace.changed:
            self.plot.show_signal("after", time_s, scale(trace.after))
        for name, sign in zip(dict(FLOOR), (1.0, -1.0), strict=True):
            floor = np.full(2, sign * trace.floor * scale.per_si)
            self.plot.show_signal(name, time_s[[0, -1]], floor)
        self.plot.set_time(0.0, max(float(time_s[-1]), 1e-9))
        self.plot.enableAutoRange(axis="y")
