"""A plot in the window's colours that is fast enough to be redrawn in every frame."""

from typing import Any, NamedTuple

import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QWidget

from rotemina.app.language import translate
from rotemina.app.widgets.style import StaggeredPainting, Theme
from rotemina.sim.arrays import FloatArray, decimate_to_envelope
from rotemina.sim.messages import localize_number

# The width and margin are fixed, so that plots above each other line up and never shift.
AXIS_WIDTH_PX = 68
RIGHT_MARGIN_PX = 12
# Opacity of the text colour in the band of the noise floor.
NOISE_BAND_ALPHA = 0.15
# As many as the panel with the most plots has.
MAX_SPARE_PLOTS = 6
# The vertical scale is adapted when the signal fills less than this share of it.
_MIN_FILLED_SHARE = 0.35
_MARGIN_SHARE = 0.12


class LineStyle(NamedTuple):
    """Style of a line: colour role of the theme, width in px, dashes."""

    role: str
    width: int = 1
    style: Qt.PenStyle = Qt.PenStyle.SolidLine


#: Line styles of all plots and themes. Two lines that colour-blind users could confuse differ in
#: their dashes. Dense noise is slow to draw if it is wider than 1 px or dashed, so measured signals
#: use the plain style.
LINE_STYLES = {
    "command": LineStyle("command", style=Qt.PenStyle.DashLine),
    # Wide, so that it is visible on both sides of the measured line.
    "model": LineStyle("model", width=3),
    "nominal": LineStyle("model", style=Qt.PenStyle.DotLine),
    "doubt": LineStyle("model", style=Qt.PenStyle.DashDotLine),
    "other": LineStyle("other", style=Qt.PenStyle.DashDotDotLine),
    # The intended path.
    "reference": LineStyle("text", width=3, style=Qt.PenStyle.DotLine),
    "measured": LineStyle("real"),
    "gap": LineStyle("text"),
}


class _Axis(pg.AxisItem):
    """Axis whose numbers have the decimal sign in use."""

    def tickStrings(self, *ticks: Any) -> list[str]:  # noqa: N802 (pyqtgraph's name)
        """Return the texts at the ticks."""
        return [localize_number(text) for text in super().tickStrings(*ticks)]


def _make_plot_item() -> pg.PlotItem:
    """Return a plot item with axes and grid; this is the slow part of creating a plot."""
    axes = {side: _Axis(side) for side in ("left", "bottom")}
    item = pg.PlotItem(enableMenu=False, axisItems=axes)
    item.hideButtons()
    item.setClipToView(False)
    for axis in axes.values():
        axis.enableAutoSIPrefix(False)
        axis.setStyle(tickLength=-5, hideOverlappingLabels=True)
        # Numbers and grid rarely change, but the curves change in every frame.
        axis.setCacheMode(axis.CacheMode.DeviceCoordinateCache)
    axes["left"].setWidth(AXIS_WIDTH_PX)
    item.showGrid(x=True, y=True, alpha=0.18)
    return item


_spare_items: list[pg.PlotItem] = []


def make_spare_plot() -> bool:
    """Create a spare plot item; return whether there are enough now.

    A panel with several plots would block the window if it created them all at once.
    """
    if len(_spare_items) < MAX_SPARE_PLOTS:
        _spare_items.append(_make_plot_item())
    return len(_spare_items) >= MAX_SPARE_PLOTS


def drop_spare_plots() -> None:
    """Delete the spare plot items."""
    _spare_items.clear()


class SignalPlot(pg.PlotWidget):
    """Named curves over time, reduced to minima and maxima for each pixel column.

    The vertical scale follows the signals only when they leave it or shrink much, so that its
    numbers stay readable.
    """

    # None until the constructor sets it, because Qt calls resizeEvent earlier.
    _staggering: StaggeredPainting | None = None

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent, plotItem=_spare_items.pop() if _spare_items else _make_plot_item())
        self._curves: dict[str, pg.PlotCurveItem] = {}
        self._line_styles: dict[str, LineStyle] = {}
        self._scale: tuple[float, float] | None = None
        self._stale = False
        self.setAntialiasing(False)
        self._staggering = StaggeredPainting(
            self.viewport(), lambda: super(SignalPlot, self).resizeEvent(None)
        )
        self.set_theme(theme)

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 (Qt's name)
        """Schedule the painting of the plot."""
        super().showEvent(event)
        self._staggering.hold()

    def resizeEvent(self, event: QResizeEvent | None) -> None:  # noqa: N802 (Qt's name)
        """Fit axes and curves to the size; while visible, this waits for the plot's turn."""
        if self._staggering is not None and self.isVisible():
            self._staggering.hold()
        else:
            super().resizeEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Paint only the background until the plot's turn comes."""
        if self._staggering is not None and self._staggering.is_held:
            QPainter(self.viewport()).fillRect(event.rect(), QColor(self._theme.surface))
        else:
            super().paintEvent(event)

    def paint_now(self) -> None:
        """Paint now, for example for a picture of the window."""
        self._staggering.release()

    def add_curve(self, name: str, line: LineStyle) -> None:
        """Add a curve with its line style."""
        curve = pg.PlotCurveItem(skipFiniteCheck=True)
        self._curves[name] = curve
        self._line_styles[name] = line
        self.addItem(curve)
        self._colour_curve(name)

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self.setBackground(QColor(theme.surface))
        for side in ("left", "bottom"):
            axis = self.getPlotItem().getAxis(side)
            axis.setPen(QColor(theme.line))
            axis.setTextPen(QColor(theme.quiet))
        for name in self._curves:
            self._colour_curve(name)

    def set_stale(self, stale: bool) -> None:
        """Draw all curves in grey if they are out of date, else in their colours."""
        if stale != self._stale:
            self._stale = stale
            for name in self._curves:
                self._colour_curve(name)

    def show_times(self, shown: bool) -> None:
        """Show or hide the numbers of the time axis."""
        axis = self.getPlotItem().getAxis("bottom")
        axis.setStyle(showValues=shown)
        if shown:
            axis.setLabel(translate("shell", "time [s]"))
        self.getPlotItem().layout.setContentsMargins(0, 4, RIGHT_MARGIN_PX, 0 if shown else 4)

    def show_signal(self, name: str, time_s: FloatArray, values: FloatArray) -> None:
        """Draw a signal (n,), reduced to what the width can show.

        A wide line is reduced further, because it hides details narrower than itself.
        """
        width = self._line_styles[name].width
        buckets = max(self.width(), 200) // (width + 1)
        self._draw(name, *decimate_to_envelope(time_s, values, buckets))

    def clear_signal(self, name: str) -> None:
        """Draw nothing for a curve."""
        curve = self._curves[name]
        if curve.isVisible():
            curve.setData([], [])
            # A hidden curve takes no time to draw.
            curve.hide()

    def _draw(self, name: str, x: FloatArray, y: FloatArray) -> None:
        self._curves[name].setData(x, y)
        self._curves[name].show()

    def set_time_span(self, start_s: float, end_s: float) -> None:
        """Show this span of time."""
        if self.viewRange()[0] != [start_s, end_s]:
            self.setXRange(start_s, end_s, padding=0.0)

    def fit_scale(self, low: float, high: float, min_height: float) -> None:
        """Fit the vertical scale to ``low … high``, with a height of at least ``min_height``."""
        centre, height = (low + high) / 2, max(high - low, min_height)
        if self._scale is not None:
            bottom, top = self._scale
            is_inside = bottom <= low and high <= top
            if is_inside and height > _MIN_FILLED_SHARE * (top - bottom):
                return
        half_height = height * (0.5 + _MARGIN_SHARE)
        self._scale = (centre - half_height, centre + half_height)
        self.setYRange(*self._scale, padding=0.0)

    def _colour_curve(self, name: str) -> None:
        role, width, style = self._line_styles[name]
        colour = QColor(getattr(self._theme, "quiet" if self._stale else role))
        self._curves[name].setPen(pg.mkPen(colour, width=width, style=style))
