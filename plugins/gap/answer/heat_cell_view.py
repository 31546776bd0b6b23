"""Plot of the traces behind a cell of the heat map: the total gap, and the part in the cell."""

from collections.abc import Sequence
from html import escape

import numpy as np
from PySide6.QtCore import Signal
from PySide6.QtWidgets import QComboBox, QLabel, QPushButton, QWidget

from rotemina.app.widgets.drawing import LineStyle, SignalPlot
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.style import Theme
from rotemina.app.widgets.text import make_plain_label
from rotemina.plugins.gap import tr
from rotemina.plugins.gap.answer.heat_cell import HeatCellContribution
from rotemina.sim.units import choose_scale, format_quantity

CURVE_ROLES = (("whole", "command"), ("within", "real"))


class HeatCellView(QWidget):
    """Plot of one record, with a choice of the record and a button back to the map.

    Signals
    -------
    closed() : the operator wants to return to the map.
    """

    closed = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.back = QPushButton(tr("◂ Map"))
        self.back.setToolTip(tr("Back to the map of the gap by band and regime"))
        self.back.clicked.connect(self.closed)
        self.title = make_plain_label(quiet=False)
        self.choice = QComboBox()
        self.choice.setAccessibleName(tr("Record"))
        self.choice.setToolTip(tr("Records by their share of this cell, largest first"))
        policy = QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
        self.choice.setSizeAdjustPolicy(policy)
        self.choice.setMinimumContentsLength(10)
        self.choice.activated.connect(lambda _: self._draw())
        self.legend = QLabel()
        self.plot = SignalPlot(theme)
        for name, role in CURVE_ROLES:
            self.plot.add_curve(name, LineStyle(role))
        self.plot.show_times(True)
        header = make_row(self.back, (self.title, 1), self.choice)
        make_column(header, self.legend, (self.plot, 1), on=self, margins=(4, 0, 0, 0), spacing=2)

    def show_contributions(
        self, title: str, names: Sequence[str], parts: Sequence[HeatCellContribution]
    ) -> None:
        """Show the contributions of records to a cell."""
        self.title.setText(title)
        self.choice.clear()
        for contribution in parts:
            self.choice.addItem(names[contribution.trace.number], contribution)
        self._draw()

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self.plot.set_theme(theme)
        self._draw()

    def _draw(self) -> None:
        contribution: HeatCellContribution | None = self.choice.currentData()
        for name, _ in CURVE_ROLES:
            self.plot.clear_signal(name)
        if contribution is None:
            self.legend.setText(tr("No record has samples in this cell."))
            return
        trace, theme = contribution.trace, self._theme
        scale = choose_scale(trace.unit, float(np.abs(trace.gap_before).max()))
        text = tr(
            'gap [{unit}]: <span style="color:{command}">total</span>, <span '
            'style="color:{real}">in this band</span>: {rms} rms in {time:.3g} s'
        )
        self.legend.setText(
            text.format(
                unit=escape(scale.symbol),
                command=theme.command,
                real=theme.real,
                rms=escape(format_quantity(contribution.rms, trace.unit)),
                time=contribution.duration_s,
            )
        )
        self.plot.show_signal("whole", trace.time_s, scale(trace.gap_before))
        self.plot.show_signal("within", trace.time_s, scale(contribution.gap_in_cell))
        self.plot.set_time_span(0.0, max(float(trace.time_s[-1]), 1e-9))
        self.plot.enableAutoRange(axis="y")
