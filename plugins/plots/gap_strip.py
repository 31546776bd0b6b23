"""The gap over time below a plot, with noise bounds and the following bound."""

import math

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QBrush, QColor, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.display_units import label, noticeable
from rotemina.app.shell.plot import AXIS_WIDTH, BAND, RIGHT_MARGIN
from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.controls import plain_tip
from rotemina.plugins.plots import tr
from rotemina.plugins.plots.history_signals import SHORT_S
from rotemina.sim.arrays import FloatArray
from rotemina.sim.comparison.gap import gap_text
from rotemina.sim.quantities import rounded
from rotemina.sim.robot.model import Axis

LEAST_HEIGHT, MOST_HEIGHT = 20, 50  # px
_LEAST_FLOORS, _LOWEST = 20.0, 0.5  # ends of the scale
_STEP = 10.0  # by what the upper end grows
_LETTERS = 0.8  # of the window's text


class GapStrip(QWidget):
    """The rms gap of the last half second, on a logarithmic scale; the noise floor is a band.

    Dotted lines are what noise alone does not make, and the following bound: above them the curve
    is amber and red. There is no curve where nothing moved; it is grey where data is old.

    Parameters
    ----------
    theme : Theme
    name : str
        Of the axis.
    axis : Axis
    floor : float
        Of its sensor, m or rad.
    """

    def __init__(self, theme: Theme, name: str, axis: Axis, floor: float) -> None:
        super().__init__()
        self._theme, self._unit, self._floor = theme, axis.unit or "m", floor
        noise = max(noticeable(axis), floor)
        following = max(axis.following, noise)
        # Sizes, m or rad, from which on the curve has a colour of its own.
        self.bounds = {"warning": noise, "danger_text": following}
        self.top = _LEAST_FLOORS * floor
        self._stale = False
        self._lines: list[QPolygonF] = []
        self._since_s = self._values = np.empty(0)
        self._span_s = 1.0
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setAccessibleName(tr("Gap of {axis}").format(axis=label(name)))
        self.setToolTip(plain_tip(*self._explained(noise, following)))

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self.update()

    def set_stale(self, stale: bool) -> None:
        """Draw in grey and hatched, or in colours again."""
        if stale != self._stale:
            self._stale = stale
            self.update()

    def show_course(self, since_s: FloatArray, values: FloatArray, span_s: float) -> None:
        """Draw the gap (n,), m or rad; its times (n,), s, count back from 0, the newest sample."""
        self._since_s, self._values, self._span_s = since_s, values, span_s
        peak = float(np.nanmax(values, initial=0.0))
        least = _LEAST_FLOORS * self._floor
        steps = math.ceil(math.log(max(peak / least, 1.0), _STEP))
        self.top = least * _STEP**steps
        self.update()

    def track(self) -> QRectF:
        """Return where the curve is drawn, below that of the plot."""
        width = max(self.width() - AXIS_WIDTH - RIGHT_MARGIN, 1)
        return QRectF(AXIS_WIDTH, 1, width, max(self.height() - 3, 1))

    def height_of(self, size: float) -> float:
        """Return where a gap (m or rad) is drawn."""
        return float(self._heights(np.array([size]))[0])

    def _heights(self, sizes: FloatArray) -> FloatArray:
        track, lowest = self.track(), _LOWEST * self._floor
        shares = np.log(np.maximum(sizes, lowest) / lowest) / math.log(self.top / lowest)
        return np.asarray(track.bottom() - np.minimum(shares, 1.0) * track.height())

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw ground, band, scale and curve."""
        painter, theme, track = QPainter(self), self._theme, self.track()
        painter.fillRect(self.rect(), QColor(theme.surface))
        if self._stale:
            painter.fillRect(track, QBrush(QColor(theme.line), Qt.BrushStyle.BDiagPattern))
        band = QColor(theme.text)
        band.setAlphaF(BAND)
        floor = QPointF(track.left(), self.height_of(self._floor))
        painter.fillRect(QRectF(floor, track.bottomRight()), band)
        self._write_scale(painter, track)
        self._draw_curve(painter, track)
        painter.end()

    def _draw_curve(self, painter: QPainter, track: QRectF) -> None:
        """Draw the curve from each bound to the next in a colour of its own, and the bounds."""
        pieces = self._pieces(track)
        below, role, above = track.bottom(), "text", 0.0
        peak = float(np.nanmax(self._values, initial=0.0))
        for next_role, size in (*self.bounds.items(), ("", np.inf)):
            at = self.height_of(size)
            colour = QColor(getattr(self._theme, "quiet" if self._stale else role))
            painter.setClipRect(QRectF(QPointF(track.left(), at), QPointF(track.right(), below)))
            painter.setPen(QPen(colour, 1 if role == "text" else 2))
            for piece in pieces if peak >= above else ():  # dense lines are slow to draw
                painter.drawPolyline(piece)
            painter.setClipping(False)
            if size >= self.top:
                return
            painter.setPen(QPen(QColor(getattr(self._theme, next_role)), 1, Qt.PenStyle.DotLine))
            painter.drawLine(QPointF(track.left(), at), QPointF(track.right(), at))
            below, role, above = at, next_role, size

    def _pieces(self, track: QRectF) -> list[QPolygonF]:
        """Return the curve, torn where nothing counted."""
        across = track.right() + self._since_s / self._span_s * track.width()
        along = self._heights(self._values)
        points = list(map(QPointF, across.tolist(), along.tolist()))
        known = np.isfinite(self._values)
        ends = np.flatnonzero(np.diff(known, prepend=False, append=False))
        return [
            QPolygonF(points[first:last]) for first, last in zip(ends[::2], ends[1::2], strict=True)
        ]

    def _write_scale(self, painter: QPainter, track: QRectF) -> None:
        """Write the upper end of the scale and, where there is room, the floor."""
        font = painter.font()
        font.setPixelSize(max(round(_LETTERS * self.fontInfo().pixelSize()), 8))
        painter.setFont(font)
        painter.setPen(QColor(self._theme.quiet))
        room = QRectF(0, track.top(), AXIS_WIDTH - 5, track.height())
        side = Qt.AlignmentFlag
        ends = [(gap_text(self.top, self._unit), side.AlignTop)]
        if track.height() >= 2 * painter.fontMetrics().height():
            ends.append((gap_text(self._floor, self._unit), side.AlignBottom))
        widest = max(painter.fontMetrics().horizontalAdvance(text) for text, _ in ends)
        if widest > room.width():  # the axes' width is fixed, however large text is
            font.setPixelSize(max(int(font.pixelSize() * room.width() / widest), 8))
            painter.setFont(font)
        for text, end in ends:
            painter.drawText(room, int(side.AlignRight | end), text)

    def _explained(self, noise: float, bound: float) -> list[str]:
        floor, noise_text, bound_text = (
            gap_text(size, self._unit) for size in (self._floor, noise, bound)
        )
        return [
            tr("Gap of the last {n} s, while an axis moves; logarithmic scale").format(
                n=rounded(SHORT_S, 2)
            ),
            tr("Band: noise floor of the sensor, {floor}").format(floor=floor),
            tr("Amber: above the noise, {noise}").format(noise=noise_text),
            tr("Red: beyond the following bound, {bound}").format(bound=bound_text),
        ]
