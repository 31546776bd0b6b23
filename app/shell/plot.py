"""A plot in the window's colours, cheap enough to be redrawn at every frame."""

from typing import Any, NamedTuple

import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QWidget

from rotemina.app.shell.language import translate
from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.painted_in_turn import PaintedInTurn
from rotemina.sim.arrays import FloatArray
from rotemina.sim.decimation import envelope
from rotemina.sim.quantities import localized

AXIS_WIDTH = 68  # fixed, so that plots above each other line up and never shift
RIGHT_MARGIN = 12  # px beside a plot, as fixed
BAND = 0.15  # of the text's colour: the noise floor
PLOTS_AHEAD = 6  # as many as one panel has at most
_SHRINK = 0.35  # the scale is tightened when the signal fills less than this of it
_MARGIN = 0.12


class Line(NamedTuple):
    """How a signal is drawn: colour role of the theme, width in px, dashes."""

    role: str
    width: int = 1
    style: Qt.PenStyle = Qt.PenStyle.SolidLine


#: What is drawn how, in every plot and theme: two lines that colour-blind eyes confuse differ in
#: their dashes. Dense noise is slow to draw wider than 1 px or dashed: what is measured is neither.
LINES = {
    "command": Line("command", style=Qt.PenStyle.DashLine),
    "model": Line("model", width=3),  # seen on both sides of the measured line
    "nominal": Line("model", style=Qt.PenStyle.DotLine),
    "doubt": Line("model", style=Qt.PenStyle.DashDotLine),
    "other": Line("other", style=Qt.PenStyle.DashDotDotLine),
    "reference": Line("text", width=3, style=Qt.PenStyle.DotLine),  # what was wanted
    "measured": Line("real"),
    "gap": Line("text"),
}


class _Axis(pg.AxisItem):
    """An axis whose numbers have the decimal sign in use."""

    def tickStrings(self, *ticks: Any) -> list[str]:  # noqa: N802 (pyqtgraph's name)
        """Return what is written at ticks."""
        return [localized(text) for text in super().tickStrings(*ticks)]


def _new_item() -> pg.PlotItem:
    """Return axes and grid of a plot: most of what takes long to make of it."""
    axes = {side: _Axis(side) for side in ("left", "bottom")}
    item = pg.PlotItem(enableMenu=False, axisItems=axes)
    item.hideButtons()
    item.setClipToView(False)
    for axis in axes.values():
        axis.enableAutoSIPrefix(False)
        axis.setStyle(tickLength=-5, hideOverlappingLabels=True)
        # Numbers and grid change seldom, the curves at every frame.
        axis.setCacheMode(axis.CacheMode.DeviceCoordinateCache)
    axes["left"].setWidth(AXIS_WIDTH)
    item.showGrid(x=True, y=True, alpha=0.18)
    return item


_made_ahead: list[pg.PlotItem] = []


def make_plot_ahead() -> bool:
    """Make part of a plot that is needed later; return whether there are enough now.

    A panel with several plots would hold the window up if it made them all at once.
    """
    if len(_made_ahead) < PLOTS_AHEAD:
        _made_ahead.append(_new_item())
    return len(_made_ahead) >= PLOTS_AHEAD


def drop_plots_ahead() -> None:
    """Free those that nobody needs any more."""
    _made_ahead.clear()


class SignalPlot(pg.PlotWidget):
    """Named curves over time, decimated to the width by lowest and highest values.

    The vertical scale follows the signals, but only when they leave it or shrink far, so that
    its numbers can be read.
    """

    _turn: PaintedInTurn | None = None  # until it is made

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent, plotItem=_made_ahead.pop() if _made_ahead else _new_item())
        self._curves: dict[str, pg.PlotCurveItem] = {}
        self._pens: dict[str, Line] = {}
        self._scale: tuple[float, float] | None = None
        self._stale = False
        self.setAntialiasing(False)
        self._turn = PaintedInTurn(
            self.viewport(), lambda: super(SignalPlot, self).resizeEvent(None)
        )
        self.set_theme(theme)

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 (Qt's name)
        """Be painted when its turn comes."""
        super().showEvent(event)
        self._turn.hold()

    def resizeEvent(self, event: QResizeEvent | None) -> None:  # noqa: N802 (Qt's name)
        """Fit axes and curves to the size: while it is seen, when its turn to be painted comes."""
        if self._turn is not None and self.isVisible():
            self._turn.hold()
        else:
            super().resizeEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Paint the ground alone until its turn comes."""
        if self._turn is not None and self._turn.is_held:
            QPainter(self.viewport()).fillRect(event.rect(), QColor(self._theme.surface))
        else:
            super().paintEvent(event)

    def settle(self) -> None:
        """Be painted now, such as for a picture of the window."""
        self._turn.release()

    def add_curve(self, name: str, line: Line) -> None:
        """Add a curve; what has its way in :data:`LINES` is drawn so."""
        curve = pg.PlotCurveItem(skipFiniteCheck=True)
        self._curves[name] = curve
        self._pens[name] = line
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
        """Draw all curves in grey, or in their colours again."""
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
        self.getPlotItem().layout.setContentsMargins(0, 4, RIGHT_MARGIN, 0 if shown else 4)

    def show_signal(self, name: str, time_s: FloatArray, values: FloatArray) -> None:
        """Draw a signal (n,), thinned to what the width can show.

        A wide line is thinned further: it hides what is narrower than itself.
        """
        width = self._pens[name].width
        buckets = max(self.width(), 200) // (width + 1)
        self._draw(name, *envelope(time_s, values, buckets))

    def clear_signal(self, name: str) -> None:
        """Draw nothing for a curve."""
        curve = self._curves[name]
        if curve.isVisible():
            curve.setData([], [])
            curve.hide()  # the scene passes it over

    def _draw(self, name: str, x: FloatArray, y: FloatArray) -> None:
        self._curves[name].setData(x, y)
        self._curves[name].show()

    def set_time(self, start_s: float, end_s: float) -> None:
        """Show this span of time."""
        if self.viewRange()[0] != [start_s, end_s]:
            self.setXRange(start_s, end_s, padding=0.0)

    def follow(self, low: float, high: float, least: float) -> None:
        """Make the vertical scale fit ``low … high``, at least ``least`` high."""
        middle, height = (low + high) / 2, max(high - low, least)
        if self._scale is not None:
            bottom, top = self._scale
            inside = bottom <= low and high <= top
            if inside and height > _SHRINK * (top - bottom):
                return
        half = height * (0.5 + _MARGIN)
        self._scale = (middle - half, middle + half)
        self.setYRange(*self._scale, padding=0.0)

    def _colour_curve(self, name: str) -> None:
        role, width, style = self._pens[name]
        colour = QColor(getattr(self._theme, "quiet" if self._stale else role))
        self._curves[name].setPen(pg.mkPen(colour, width=width, style=style))
