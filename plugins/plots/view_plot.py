"""Plot of any curve, with two cursors."""

from collections.abc import Callable, Sequence

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor

from rotemina.app.widgets.drawing import SignalPlot
from rotemina.app.widgets.style import Theme
from rotemina.plugins.plots.spectra_and_loops import thin_loop
from rotemina.sim.arrays import FloatArray

# The horizontal scale shrinks if the curves fill less than this fraction of it.
_MIN_FILLED_FRACTION = 0.35
# Margin on either side of the curves, relative to their width.
_MARGIN_RATIO = 0.08


class ViewPlot(SignalPlot):
    """Plot of signals over time, loops, or spectra on logarithmic scales, with cursors A and B.

    The positions of the cursors are in the coordinates of the axes, which are logarithms on a
    logarithmic scale.
    """

    def __init__(self, theme: Theme, on_cursor_moved: Callable[["ViewPlot"], None]) -> None:
        self._cursor_lines: tuple[pg.InfiniteLine, ...] = ()
        self._x_range: tuple[float, float] | None = None
        super().__init__(theme)
        self._on_cursor_moved = on_cursor_moved
        self._cursor_lines = tuple(
            pg.InfiniteLine(angle=angle, movable=True) for angle in (90, 90, 0, 0)
        )
        for line in self._cursor_lines:
            line.setVisible(False)
            line.sigPositionChanged.connect(self._report_cursor_move)
            self.addItem(line, ignoreBounds=True)
        self._colour_cursor_lines()

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        super().set_theme(theme)
        self._colour_cursor_lines()

    def show_scales(self, label: str, *, logarithmic: bool, numbers: bool) -> None:
        """Set the label of the horizontal axis, and whether both scales are logarithmic."""
        item = self.getPlotItem()
        item.getAxis("bottom").setLogMode(x=logarithmic)
        item.getAxis("left").setLogMode(y=logarithmic)
        self.show_times(numbers)
        item.getAxis("bottom").setLabel(label if numbers else "")
        item.getAxis("bottom").showLabel(numbers and bool(label))
        self._scale = self._x_range = None

    def show_loop(self, name: str, x: FloatArray, y: FloatArray) -> None:
        """Draw a curve through points (n,), thinned to the resolution of the plot.

        A wide line is thinned further, because it hides details narrower than the line.
        """
        width = self._line_styles[name].width
        self._draw(name, *thin_loop(x, y, max(self.width(), 200) // (2 * width)))

    def fit_horizontal_scale(self, low: float, high: float, min_width: float) -> None:
        """Fit the horizontal scale to the curves, as :meth:`fit_scale` fits the vertical one."""
        centre, width = (low + high) / 2, max(high - low, min_width)
        if self._x_range is not None:
            left, right = self._x_range
            if left <= low and high <= right and width > _MIN_FILLED_FRACTION * (right - left):
                return
        half_width = width * (0.5 + _MARGIN_RATIO)
        self._x_range = (centre - half_width, centre + half_width)
        self.setXRange(*self._x_range, padding=0.0)

    def show_cursors(self, *, vertical: bool, horizontal: bool) -> None:
        """Show or hide the vertical and the horizontal lines of the cursors.

        The lines are placed at about one third and two thirds of the visible range.
        """
        (left, right), (bottom, top) = self.viewRange()
        positions = [
            low + fraction * (high - low)
            for low, high in ((left, right), (bottom, top))
            for fraction in (0.35, 0.65)
        ]
        self._place_lines(positions)
        visibilities = (vertical, vertical, horizontal, horizontal)
        for line, is_visible in zip(self._cursor_lines, visibilities, strict=True):
            line.setVisible(is_visible)

    def place_cursors(self, a: float, b: float) -> None:
        """Move the vertical lines of cursors A and B."""
        self._place_lines((a, b))

    def _place_lines(self, positions: Sequence[float]) -> None:
        """Move lines without their signal, which reports only moves by the operator."""
        for line, position in zip(self._cursor_lines, positions, strict=False):
            were_signals_blocked = line.blockSignals(True)
            line.setValue(position)
            line.blockSignals(were_signals_blocked)

    @property
    def cursors(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """The positions (x, y) of A and B."""
        values = [float(line.value()) for line in self._cursor_lines]
        return (values[0], values[2]), (values[1], values[3])

    def _report_cursor_move(self) -> None:
        self._on_cursor_moved(self)

    def _colour_cursor_lines(self) -> None:
        for index, line in enumerate(self._cursor_lines):
            style = Qt.PenStyle.DashLine if index % 2 else Qt.PenStyle.SolidLine
            line.setPen(pg.mkPen(QColor(self._theme.text), width=1, style=style))
            line.setHoverPen(pg.mkPen(QColor(self._theme.accent), width=2))


def compute_log10(values: FloatArray) -> FloatArray:
    """Return log10 of values.

    A value that is not positive is replaced by the smallest positive one. If no value is positive,
    all results are NaN.
    """
    positive = values[values > 0.0]
    if len(positive) == 0:
        return np.full_like(values, np.nan)
    return np.log10(np.maximum(values, positive.min()))
