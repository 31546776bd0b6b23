"""Strip below a plot with the gap over time, the noise floor and the following bound."""

import math

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QBrush, QColor, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.language import find_noticeable_change, get_axis_label
from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.widgets.drawing import (
    AXIS_WIDTH_PX,
    NOISE_BAND_ALPHA,
    RIGHT_MARGIN_PX,
)
from rotemina.app.widgets.style import Theme
from rotemina.plugins.plots import tr
from rotemina.plugins.plots.history_signals import GAP_WINDOW_S
from rotemina.sim.arrays import FloatArray
from rotemina.sim.comparison import format_gap
from rotemina.sim.messages import format_rounded
from rotemina.sim.robot import Axis

MIN_STRIP_HEIGHT_PX, MAX_STRIP_HEIGHT_PX = 20, 50
# Initial upper end and lower end of the scale, as multiples of the noise floor.
_MIN_TOP_RATIO, _BOTTOM_RATIO = 20.0, 0.5
# The upper end grows by this factor until the largest gap fits.
_TOP_GROWTH_RATIO = 10.0
# Size of the text relative to the text size of the window.
_TEXT_SIZE_RATIO = 0.8


class GapStrip(QWidget):
    """Strip with the rms gap of the preceding half second over time, on a logarithmic scale.

    A grey band shows the noise floor. Two dotted lines show the largest gap that noise alone can
    cause, and the following bound. The curve is amber above the first line and red above the
    second one. It is interrupted where nothing moved, and grey while the data is out of date.

    Parameters
    ----------
    theme : Theme
    name : str
        The name of the axis.
    axis : Axis
    floor : float
        The noise floor of the sensor, m or rad.
    """

    def __init__(self, theme: Theme, name: str, axis: Axis, floor: float) -> None:
        super().__init__()
        self._theme, self._unit, self._floor = theme, axis.unit or "m", floor
        noise = max(find_noticeable_change(axis), floor)
        following = max(axis.following_limit, noise)
        # Theme role of the curve above each bound (m or rad).
        self.bounds = {"warning": noise, "danger_text": following}
        self.top = _MIN_TOP_RATIO * floor
        self._stale = False
        self._since_s = self._values = np.empty(0)
        self._span_s = 1.0
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setAccessibleName(tr("Gap of {axis}").format(axis=get_axis_label(name)))
        self.setToolTip(make_tooltip(*self._make_tooltip_lines(noise, following)))

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self.update()

    def set_stale(self, stale: bool) -> None:
        """Draw outdated data in grey and hatched, other data in colours."""
        if stale != self._stale:
            self._stale = stale
            self.update()

    def show_gap_history(self, since_s: FloatArray, values: FloatArray, span_s: float) -> None:
        """Draw the gap over time.

        Parameters
        ----------
        since_s : (n,)
            Times relative to the newest sample, so at most 0, s.
        values : (n,)
            The gap, m or rad. NaN where nothing moved.
        span_s : float
        """
        self._since_s, self._values, self._span_s = since_s, values, span_s
        peak = float(np.nanmax(values, initial=0.0))
        min_top = _MIN_TOP_RATIO * self._floor
        steps = math.ceil(math.log(max(peak / min_top, 1.0), _TOP_GROWTH_RATIO))
        self.top = min_top * _TOP_GROWTH_RATIO**steps
        self.update()

    def find_track(self) -> QRectF:
        """Return the rectangle of the curve, which is as wide as the curves of the plot."""
        width = max(self.width() - AXIS_WIDTH_PX - RIGHT_MARGIN_PX, 1)
        return QRectF(AXIS_WIDTH_PX, 1, width, max(self.height() - 3, 1))

    def to_height(self, size: float) -> float:
        """Return the y coordinate of a gap, m or rad, px."""
        return float(self._to_heights(np.array([size]))[0])

    def _to_heights(self, sizes: FloatArray) -> FloatArray:
        track, bottom = self.find_track(), _BOTTOM_RATIO * self._floor
        heights = np.log(np.maximum(sizes, bottom) / bottom) / math.log(self.top / bottom)
        return np.asarray(track.bottom() - np.minimum(heights, 1.0) * track.height())

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw background, band, scale and curve."""
        painter, theme, track = QPainter(self), self._theme, self.find_track()
        painter.fillRect(self.rect(), QColor(theme.surface))
        if self._stale:
            painter.fillRect(track, QBrush(QColor(theme.line), Qt.BrushStyle.BDiagPattern))
        band = QColor(theme.text)
        band.setAlphaF(NOISE_BAND_ALPHA)
        band_corner = QPointF(track.left(), self.to_height(self._floor))
        painter.fillRect(QRectF(band_corner, track.bottomRight()), band)
        self._draw_scale_texts(painter, track)
        self._draw_curve(painter, track)
        painter.end()

    def _draw_curve(self, painter: QPainter, track: QRectF) -> None:
        pieces = self._make_curve_pieces(track)
        lower_y, role, lower_bound = track.bottom(), "text", 0.0
        peak = float(np.nanmax(self._values, initial=0.0))
        for next_role, size in (*self.bounds.items(), ("", np.inf)):
            bound_y = self.to_height(size)
            colour = QColor(getattr(self._theme, "quiet" if self._stale else role))
            painter.setClipRect(
                QRectF(QPointF(track.left(), bound_y), QPointF(track.right(), lower_y))
            )
            painter.setPen(QPen(colour, 1 if role == "text" else 2))
            # Dense curves are slow to draw, so a band that the curve does not reach is skipped.
            for piece in pieces if peak >= lower_bound else ():
                painter.drawPolyline(piece)
            painter.setClipping(False)
            if size >= self.top:
                return
            painter.setPen(QPen(QColor(getattr(self._theme, next_role)), 1, Qt.PenStyle.DotLine))
            painter.drawLine(QPointF(track.left(), bound_y), QPointF(track.right(), bound_y))
            lower_y, role, lower_bound = bound_y, next_role, size

    def _make_curve_pieces(self, track: QRectF) -> list[QPolygonF]:
        x = track.right() + self._since_s / self._span_s * track.width()
        y = self._to_heights(self._values)
        points = list(map(QPointF, x.tolist(), y.tolist()))
        has_value = np.isfinite(self._values)
        limits = np.flatnonzero(np.diff(has_value, prepend=False, append=False))
        return [
            QPolygonF(points[begin:end])
            for begin, end in zip(limits[::2], limits[1::2], strict=True)
        ]

    def _draw_scale_texts(self, painter: QPainter, track: QRectF) -> None:
        font = painter.font()
        font.setPixelSize(max(round(_TEXT_SIZE_RATIO * self.fontInfo().pixelSize()), 8))
        painter.setFont(font)
        painter.setPen(QColor(self._theme.quiet))
        text_area = QRectF(0, track.top(), AXIS_WIDTH_PX - 5, track.height())
        alignments = Qt.AlignmentFlag
        labels = [(format_gap(self.top, self._unit), alignments.AlignTop)]
        if track.height() >= 2 * painter.fontMetrics().height():
            labels.append((format_gap(self._floor, self._unit), alignments.AlignBottom))
        text_width = max(painter.fontMetrics().horizontalAdvance(text) for text, _ in labels)
        # The width of the axis is fixed, so text that does not fit is made smaller.
        if text_width > text_area.width():
            font.setPixelSize(max(int(font.pixelSize() * text_area.width() / text_width), 8))
            painter.setFont(font)
        for text, alignment in labels:
            painter.drawText(text_area, int(alignments.AlignRight | alignment), text)

    def _make_tooltip_lines(self, noise: float, bound: float) -> list[str]:
        floor, noise_text, bound_text = (
            format_gap(size, self._unit) for size in (self._floor, noise, bound)
        )
        return [
            tr("Gap of the last {n} s, while an axis moves; logarithmic scale").format(
                n=format_rounded(GAP_WINDOW_S, 2)
            ),
            tr("Band: noise floor of the sensor, {floor}").format(floor=floor),
            tr("Amber: above the noise, {noise}").format(noise=noise_text),
            tr("Red: beyond the following bound, {bound}").format(bound=bound_text),
        ]
