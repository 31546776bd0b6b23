"""How far the gap of an axis shrinks: bars, and the gap before and after over time."""

from html import escape
from math import isfinite

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QLabel, QSplitter, QVBoxLayout, QWidget

from rotemina.app.display import label
from rotemina.app.shell.plot import SignalPlot
from rotemina.app.shell.theme import Theme
from rotemina.plugins.gap.answer import Answer
from rotemina.plugins.gap.bars import Bar, Bars
from rotemina.sim.gap.diagnosis import Shrinkage
from rotemina.sim.gap.report.quantities import Scale, amount, percent, percents
from rotemina.sim.gap.report.traces import Trace
from rotemina.sim.gap.report.words import effect_title

FLOOR = (("floor above", "good"), ("floor below", "good"))


class FarView(QSplitter):
    """The waterfall on the left, the gap of one record on the right."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        self._theme = theme
        self._shown: tuple[Answer, str] | None = None
        self.title = QLabel()
        self.title.setTextFormat(Qt.TextFormat.PlainText)
        self.bars = Bars(theme)
        self.trace = QComboBox()
        self.trace.setAccessibleName("Record and tap")
        self.trace.setSizeAdjustPolicy(
            QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
        )
        self.trace.setMinimumContentsLength(14)
        self.trace.activated.connect(lambda _: self._draw())
        self.plot_title = QLabel()
        self.plot = SignalPlot(theme)
        for name, role in (*FLOOR, ("before", "command"), ("after", "model")):
            self.plot.add_curve(name, role)
        self.plot.show_times(True)
        self._lay_out()

    def _lay_out(self) -> None:
        left, right = QWidget(), QWidget()
        column = QVBoxLayout(left)
        column.addWidget(self.title)
        column.addWidget(self.bars, 1)
        head = QHBoxLayout()
        head.addWidget(self.trace)
        head.addWidget(self.plot_title, 1)
        other = QVBoxLayout(right)
        other.addLayout(head)
        other.addWidget(self.plot, 1)
        for each in (column, other):
            each.setContentsMargins(4, 0, 0, 0)
            each.setSpacing(2)
        self.addWidget(left)
        self.addWidget(right)
        self.setSizes([470, 470])

    def show_axis(self, answer: Answer, axis: str) -> None:
        """Show how far the gap of an axis shrinks."""
        self._shown = answer, axis
        told = answer.diagnosis.axes[axis].shrinkage
        self._show_bars(told[0] if told else None, answer)
        self.trace.clear()
        for trace in answer.traces[axis]:
            self.trace.addItem(f"{answer.names[trace.number]}: {trace.tap}", trace)
        if told:
            wanted = [trace.tap is told[0].tap for trace in answer.traces[axis]]
            self.trace.setCurrentIndex(wanted.index(True) if any(wanted) else 0)
        self._draw()

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self.bars.set_theme(theme)
        self.plot.set_theme(theme)
        self._draw()

    def _show_bars(self, told: Shrinkage | None, answer: Answer) -> None:
        if told is None:
            self.title.setText("No shrinkage is told of this axis.")
            self.bars.show_bars((), ())
            return
        unit = answer.unit(told.axis, told.tap)
        sizes = [("as it is", told.raw, "command"), ("re-tuned", told.retuned, "command")]
        sizes += [(f"+ {effect_title(step.effect)}", step.rms, "model") for step in told.steps]
        sizes.append(("corrected", told.corrected, "model"))
        lines = [("floor", told.floor, "good")]
        if told.ceiling is not None:
            lines.append(("black box", told.ceiling, "warning"))
        self.title.setText(
            f"{label(told.axis)} {told.tap}, rms on unseen data: closed {percent(told.closed)} "
            f"({percents(told.closed_interval)})"
        )
        self.bars.show_bars(_bars(sizes, unit), _bars(lines, unit))

    def _draw(self) -> None:
        trace: Trace | None = self.trace.currentData()
        for name in (*dict(FLOOR), "before", "after"):
            self.plot.clear_signal(name)
        if trace is None:
            self.plot_title.clear()
            return
        scale = Scale.of(trace.unit, float(np.abs(trace.before).max()))
        theme = self._theme
        after = f', <span style="color:{theme.model}">after</span>' if trace.changed else ""
        self.plot_title.setText(
            f'gap [{escape(scale.symbol)}]: <span style="color:{theme.command}">before</span>'
            f'{after}, <span style="color:{theme.good}">noise floor</span>'
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


def _bars(sizes: list[tuple[str, float, str]], unit: str) -> list[Bar]:
    return [
        Bar(name, size, amount(size, unit), role) for name, size, role in sizes if isfinite(size)
    ]
