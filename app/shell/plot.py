"""A plot in the window's colours, cheap enough to be redrawn at every frame."""

import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QWidget

from rotemina.app.shell.language import translate
from rotemina.app.shell.theme import Theme
from rotemina.sim.arrays import FloatArray
from rotemina.sim.decimation import envelope

AXIS_WIDTH = 68  # fixed, so that plots above each other line up and never shift
_SHRINK = 0.35  # the scale is tightened when the signal fills less than this of it
_MARGIN = 0.12


class SignalPlot(pg.PlotWidget):
    """Named curves over time, decimated to the width by lowest and highest values.

    The vertical scale follows the signals, but only when they leave it or shrink far, so that
    its numbers can be read.
    """

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._curves: dict[str, pg.PlotCurveItem] = {}
        self._pens: dict[str, tuple[str, int]] = {}
        self._styles: dict[str, Qt.PenStyle] = {}
        self._scale: tuple[float, float] | None = None
        self._stale = False
        self.setMenuEnabled(False)
        self.hideButtons()
        self.setAntialiasing(False)
        item = self.getPlotItem()
        item.setClipToView(False)
        for side in ("left", "bottom"):
            axis = item.getAxis(side)
            axis.enableAutoSIPrefix(False)
            axis.setStyle(tickLength=-5, hideOverlappingLabels=True)
            # Numbers and grid change seldom, the curves at every frame.
            axis.setCacheMode(axis.CacheMode.DeviceCoordinateCache)
        item.getAxis("left").setWidth(AXIS_WIDTH)
        item.showGrid(x=True, y=True, alpha=0.18)
        self.set_theme(theme)

    def add_curve(
        self, name: str, role: str, width: int = 1, style: Qt.PenStyle = Qt.PenStyle.SolidLine
    ) -> None:
        """Add a curve in the theme's colour ``role``, ``width`` pixels wide."""
        curve = pg.PlotCurveItem(skipFiniteCheck=True)
        self._curves[name] = curve
        self._pens[name] = (role, width)
        self._styles[name] = style
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
        self.getPlotItem().layout.setContentsMargins(0, 4, 12, 0 if shown else 4)

    def show_signal(self, name: str, time_s: FloatArray, values: FloatArray) -> None:
        """Draw a signal (n,), thinned to what the width can show.

        A wide line is thinned further: it hides what is narrower than itself.
        """
        _, width = self._pens[name]
        buckets = max(self.width(), 200) // (width + 1)
        self._curves[name].setData(*envelope(time_s, values, buckets))

    def clear_signal(self, name: str) -> None:
        """Draw nothing for a curve."""
        self._curves[name].setData([], [])

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
        role, width = self._pens[name]
        role = "quiet" if self._stale else role
        colour = QColor(getattr(self._theme, role))
        self._curves[name].setPen(pg.mkPen(colour, width=width, style=self._styles[name]))
