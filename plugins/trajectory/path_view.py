"""View of the path of the tip in a dry run, from above and from the side."""

import numpy as np
from PySide6.QtCore import QEvent, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QMouseEvent, QPainter, QPaintEvent, QPen, QPixmap
from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.motion.limits import TipPath
from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.widgets.drawing import (
    TipProjection,
    draw_scale_bar,
    make_forbidden_area,
)
from rotemina.app.widgets.style import Theme
from rotemina.plugins.trajectory import tr
from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics import TipWorkspace

# A longer path is downsampled to this many points.
_MAX_DRAWN_POINTS = 4000
# Margin around the path, relative to its size, and minimum margin.
_MARGIN_RATIO, _MIN_MARGIN_M = 0.15, 2e-6
# Gap between the views, and height of the caption and of the scale bar.
_GAP_PX, _CAPTION_HEIGHT_PX = 8, 16


class TipPathView(QWidget):
    """Two views of the path of the tip at the same scale.

    A click switches between the path and the whole reach of the tip.
    """

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._path: TipPath | None = None
        self._drawn_points = np.empty((0, 3))
        self._is_forbidden = np.empty(0, dtype=bool)
        self._pixmap: QPixmap | None = None
        self._projections: list[TipProjection] = []
        self._tip: tuple[float, float, float] | None = None
        self._is_approach_drawn = True
        self.shows_reach = False
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Expanding)
        self.setAccessibleName(tr("Path of the tip"))
        self.setToolTip(
            make_tooltip(
                tr(
                    "Path of the tip from above and from the side; dot: where the tip is; "
                    "dashed: approach to the first row; red: forbidden by floor, objective or "
                    "radius; frame: reach of the axes."
                ),
                tr("Click to switch between the whole reach and the path."),
            )
        )

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return the preferred size, in which two squares fit."""
        return QSize(230, 130)

    def show_path(self, path: TipPath | None) -> None:
        """Show a path. None hides the view."""
        self._path = path
        self.setVisible(path is not None)
        if path is not None:
            step = max(1, -(-len(path.rows) // _MAX_DRAWN_POINTS))
            self._drawn_points = path.rows[::step]
            # The tip must stay inside the zone.
            self._is_forbidden = path.zone.find_outside(self._drawn_points)
            self.setAccessibleDescription(
                tr("{share:.0f} % of the rows are forbidden").format(
                    share=100.0 * float(path.zone.find_outside(path.rows).mean())
                )
            )
        self._redraw()

    def show_tip(self, tip: tuple[float, float, float] | None, *, has_approach: bool) -> None:
        """Show the position of the tip.

        Parameters
        ----------
        tip : (x, y, z) or None
            The position, m.
        has_approach : bool
            Whether the next motion begins with an approach to the first row. It is then drawn.
        """
        if (tip, has_approach) != (self._tip, self._is_approach_drawn):
            self._tip, self._is_approach_drawn = tip, has_approach
            self.update()

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self._redraw()

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Switch between the path and the whole reach."""
        if event.button() is Qt.MouseButton.LeftButton:
            self.shows_reach = not self.shows_reach
            self._redraw()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw both views with their captions and one scale bar."""
        path = self._path
        if path is None:
            return
        if self._pixmap is None or self._pixmap.deviceIndependentSize().toSize() != self.size():
            self._pixmap = self._draw_pixmap(path)
        painter = QPainter(self)
        painter.drawPixmap(0, 0, self._pixmap)
        if self._tip is not None:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            for projection in self._projections:
                self._draw_tip(painter, path, projection, np.array(self._tip))
        painter.end()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 (Qt's name)
        """Redraw with another font or style."""
        super().changeEvent(event)
        self._redraw()

    def _redraw(self) -> None:
        self._pixmap = None
        self.update()

    def _draw_pixmap(self, path: TipPath) -> QPixmap:
        """Return a pixmap of everything except the tip and its approach, which move."""
        ratio = self.devicePixelRatioF()
        pixmap = QPixmap(self.size() * ratio)
        pixmap.setDevicePixelRatio(ratio)
        pixmap.fill(Qt.GlobalColor.transparent)
        low, high = self._find_corners(path)
        centre, span = 0.5 * (low + high), high - low
        width, height = (self.width() - _GAP_PX) / 2, self.height() - 2 * _CAPTION_HEIGHT_PX
        scale = min(width, height) / float(span.max())
        painter = QPainter(pixmap)
        painter.setFont(self.font())
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self._projections = []
        for left, vertical_axis in ((0.0, 1), (width + _GAP_PX, 2)):
            projection = TipProjection(
                QRectF(left, _CAPTION_HEIGHT_PX, width, height), centre, scale, vertical_axis
            )
            self._projections.append(projection)
            self._draw_view(painter, path, projection)
            painter.setPen(QColor(self._theme.quiet))
            caption = tr("above: x, y") if vertical_axis == 1 else tr("side: x, z")
            painter.drawText(
                QRectF(left, 0, width, _CAPTION_HEIGHT_PX), Qt.AlignmentFlag.AlignLeft, caption
            )
        draw_scale_bar(painter, QRectF(self.rect()), scale, QColor(self._theme.text))
        painter.end()
        return pixmap

    def _find_corners(self, path: TipPath) -> tuple[FloatArray, FloatArray]:
        """Return the corners (3,) of the shown volume, m."""
        if self.shows_reach:
            reach = TipWorkspace.of(path.zone.chain).hull
            low, high = reach.low, reach.high
        else:
            points = np.vstack((path.start_position, self._drawn_points))
            low, high = points.min(axis=0), points.max(axis=0)
        margin = max(_MARGIN_RATIO * float((high - low).max()), _MIN_MARGIN_M)
        return low - margin, high + margin

    def _draw_view(self, painter: QPainter, path: TipPath, projection: TipProjection) -> None:
        theme = self._theme
        painter.save()
        painter.setClipRect(projection.area)
        painter.fillRect(projection.area, QColor(theme.surface))
        red = QColor(theme.danger)
        red.setAlpha(60)
        painter.fillPath(make_forbidden_area(path.zone, projection), red)
        reach = TipWorkspace.of(path.zone.chain).hull
        painter.setPen(QPen(QColor(theme.line), 1.0))
        painter.drawRect(
            QRectF(projection.to_point(reach.low), projection.to_point(reach.high)).normalized()
        )
        painter.setPen(QPen(QColor(theme.accent), 1.5))
        painter.drawPolyline(projection.to_points(self._drawn_points))
        painter.setPen(QPen(QColor(theme.danger_text), 3.0))
        painter.drawPoints(projection.to_points(self._drawn_points[self._is_forbidden]))
        painter.restore()

    def _draw_tip(
        self, painter: QPainter, path: TipPath, projection: TipProjection, tip: FloatArray
    ) -> None:
        painter.save()
        painter.setClipRect(projection.area)
        if self._is_approach_drawn:
            painter.setPen(QPen(QColor(self._theme.quiet), 1.0, Qt.PenStyle.DashLine))
            painter.drawLine(projection.to_point(tip), projection.to_point(path.rows[0]))
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(self._theme.text))
        painter.drawEllipse(projection.to_point(tip), 3.0, 3.0)
        painter.restore()
