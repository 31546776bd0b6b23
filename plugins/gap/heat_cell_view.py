"""The traces behind a cell of the heat map: the whole gap, and what of it is in the cell."""

from collections.abc import Sequence
from html import escape

import numpy as np
from PySide6.QtCore import Signal
from PySide6.QtWidgets import QComboBox, QLabel, QPushButton, QWidget

from rotemina.app.shell.plot import Line, SignalPlot
from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.plugins.gap import tr
from rotemina.plugins.gap.heat_cell import Part
from rotemina.sim.quantities import amount, scale_of

CURVES = (("whole", "command"), ("within", "real"))


class HeatCellView(QWidget):
    """A plot of one record, with a choice of the others, and a way back to the map.

    Signals
    -------
    closed() : the map is wanted again.
    """

    closed = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.back = QPushButton(tr("◂ Map"))
        self.back.setToolTip(tr("Back to the map of the gap by band and regime"))
        self.back.clicked.connect(self.closed)
        self.title = plain_text(quiet=False)
        self.choice = QComboBox()
        self.choice.setAccessibleName(tr("Record"))
        self.choice.setToolTip(tr("Records by their share of this place, largest first"))
        policy = QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
        self.choice.setSizeAdjustPolicy(policy)
        self.choice.setMinimumContentsLength(10)
        self.choice.activated.connect(lambda _: self._draw())
        self.legend = QLabel()
        self.plot = SignalPlot(theme)
        for name, role in CURVES:
            self.plot.add_curve(name, Line(role))
        self.plot.show_times(True)
        head = in_row(self.back, (self.title, 1), self.choice)
        in_column(head, self.legend, (self.plot, 1), on=self, margins=(4, 0, 0, 0), spacing=2)

    def show_parts(self, title: str, names: Sequence[str], parts: Sequence[Part]) -> None:
        """Show what records hold of a cell."""
        self.title.setText(title)
        self.choice.clear()
        for part in parts:
            self.choice.addItem(names[part.trace.number], part)
        self._draw()

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self.plot.set_theme(theme)
        self._draw()

    def _draw(self) -> None:
        part: Part | None = self.choice.currentData()
        for name, _ in CURVES:
            self.plot.clear_signal(name)
        if part is None:
            self.legend.setText(tr("No record has rows at this place."))
            return
        trace, theme = part.trace, self._theme
        scale = scale_of(trace.unit, float(np.abs(trace.before).max()))
        text = tr(
            'gap [{unit}]: <span style="color:{command}">total</span>, <span '
            'style="color:{real}">in this band</span>: {rms} rms in {time:.3g} s'
        )
        self.legend.setText(
            text.format(
                unit=escape(scale.symbol),
                command=theme.command,
                real=theme.real,
                rms=escape(amount(part.rms, trace.unit)),
                time=part.seconds,
            )
        )
        self.plot.show_signal("whole", trace.time_s, scale(trace.before))
        self.plot.show_signal("within", trace.time_s, scale(part.within))
        self.plot.set_time(0.0, max(float(trace.time_s[-1]), 1e-9))
        self.plot.enableAutoRange(axis="y")
