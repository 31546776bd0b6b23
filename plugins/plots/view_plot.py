"""A plot of any curve, with two cursors."""

from collections.abc import Callable, Sequence

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor

from rotemina.app.shell.plot import SignalPlot
from rotemina.app.shell.theme import Theme
from rotemina.plugins.plots.spectra_and_loops import thinned_loop
from rotemina.sim.arrays import FloatArray

_SHRINK, _MARGIN = 0.35, 0.08


class ViewPlot(SignalPlot):
    """Signals over time, loops, or spectra on logarithmic scales; cursors A and B on demand.

    Cursors are places on the axes as they are drawn, so logarithms on a logarithmic scale.
    """

    def __init__(self, theme: Theme, moved: Callable[["ViewPlot"], None]) -> None:
        self._lines: tuple[pg.InfiniteLine, ...] = ()
        self._across: tuple[float, float] | None = None
        super().__init__(theme)
        self._moved = moved
        self._lines = tuple(pg.InfiniteLine(angle=angle, movable=True) for angle in (90, 90, 0, 0))
        for line in self._lines:
            line.setVisible(False)
            line.sigPositionChanged.connect(self._tell)
            self.addItem(line, ignoreBounds=True)
        self._colour_lines()

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        super().set_theme(theme)
        self._colour_lines()

    def show_scales(self, label: str, *, logarithmic: bool, numbers: bool) -> None:
        """Say what is across, and how both scales count."""
        item = self.getPlotItem()
        item.getAxis("bottom").setLogMode(x=logarithmic)
        item.getAxis("left").setLogMode(y=logarithmic)
        self.show_times(numbers)
        item.getAxis("bottom").setLabel(label if numbers else "")
        item.getAxis("bottom").showLabel(numbers and bool(label))
        self._scale = self._across = None

    def show_loop(self, name: str, x: FloatArray, y: FloatArray) -> None:
        """Draw a curve through points (n,), thinned to what the plot can show.

        A wide line is thinned further: it hides what is narrower than itself.
        """
        width = self._pens[name].width
        self._draw(name, *thinned_loop(x, y, max(self.width(), 200) // (2 * width)))

    def follow_across(self, low: float, high: float, least: float) -> None:
        """Make the horizontal scale fit, as :meth:`follow` does the vertical one."""
        middle, width = (low + high) / 2, max(high - low, least)
        if self._across is not None:
            left, right = self._across
            if left <= low and high <= right and width > _SHRINK * (right - left):
                return
        half = width * (0.5 + _MARGIN)
        self._across = (middle - half, middle + half)
        self.setXRange(*self._across, padding=0.0)

    # --- cursors ----------------------------------------------------------------------------------

    def show_cursors(self, *, across: bool, along: bool) -> None:
        """Show the upright and the level cursors anew, at a third of what is in sight, or hide."""
        (left, right), (bottom, top) = self.viewRange()
        places = [
            low + share * (high - low)
            for low, high in ((left, right), (bottom, top))
            for share in (0.35, 0.65)
        ]
        self._place(places)
        for line, shown in zip(self._lines, (across, across, along, along), strict=True):
            line.setVisible(shown)

    def place_cursors(self, a: float, b: float) -> None:
        """Move the upright cursors."""
        self._place((a, b))

    def _place(self, places: Sequence[float]) -> None:
        """Move lines; only an operator's hand is told."""
        for line, at in zip(self._lines, places, strict=False):
            blocked = line.blockSignals(True)
            line.setValue(at)
            line.blockSignals(blocked)

    @property
    def cursors(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Places (across, along) of A and B."""
        values = [float(line.value()) for line in self._lines]
        return (values[0], values[2]), (values[1], values[3])

    def _tell(self) -> None:
        self._moved(self)

    def _colour_lines(self) -> None:
        for number, line in enumerate(self._lines):
            style = Qt.PenStyle.DashLine if number % 2 else Qt.PenStyle.SolidLine
            line.setPen(pg.mkPen(QColor(self._theme.text), width=1, style=style))
            line.setHoverPen(pg.mkPen(QColor(self._theme.accent), width=2))


def logarithm(values: FloatArray) -> FloatArray:
    """Return log10 of values; what is not above 0 gets the least that is, or NaN."""
    positive = values[values > 0.0]
    if len(positive) == 0:
        return np.full_like(values, np.nan)
    return np.log10(np.maximum(values, positive.min()))
