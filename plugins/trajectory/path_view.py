"""The path of the tip as a dry run has it: from above and from the side, over what is allowed."""

import numpy as np
from PySide6.QtCore import QEvent, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QMouseEvent, QPainter, QPaintEvent, QPen, QPixmap
from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.motion.guard import TipPath
from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.controls import plain_tip
from rotemina.app.widgets.tip_frame import TipFrame, draw_scale, forbidden
from rotemina.plugins.trajectory import tr
from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.workspace import Workspace

_MOST_POINTS = 4000  # of a path that are drawn
_MARGIN, _LEAST = 0.15, 2e-6  # about the path: a share of it, and m
_GAP, _CAPTION = 8, 16  # px; the scale bar is as high as the caption


class PathView(QWidget):
    """Two views at one scale; a click changes between the path and all that the tip can reach."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._path: TipPath | None = None
        self._rows = np.empty((0, 3))
        self._out = np.empty(0, dtype=bool)
        self._drawn: QPixmap | None = None
        self._frames: list[TipFrame] = []  # of the drawn views
        self._tip: tuple[float, float, float] | None = None
        self._approaches = True
        self.whole = False
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Expanding)
        self.setAccessibleName(tr("Path of the tip"))
        self.setToolTip(
            plain_tip(
                tr(
                    "Path of the tip from above and from the side; dot: where the tip is; "
                    "dashed: approach to the first row; red: forbidden by floor, objective or "
                    "radius; frame: reach of the axes."
                ),
                tr("Click to switch between the whole reach and the path."),
            )
        )

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Ask for room for two squares."""
        return QSize(230, 130)

    def show_path(self, path: TipPath | None) -> None:
        """Draw another path; without one there is nothing to be seen."""
        self._path = path
        self.setVisible(path is not None)
        if path is not None:
            step = max(1, -(-len(path.rows) // _MOST_POINTS))
            self._rows = path.rows[::step]
            self._out = path.zone.outside(self._rows)
            self.setAccessibleDescription(
                tr("{share:.0f} % of the rows are forbidden").format(
                    share=100.0 * float(path.zone.outside(path.rows).mean())
                )
            )
        self._renew()

    def show_tip(self, tip: tuple[float, float, float] | None, *, approaches: bool) -> None:
        """Mark where the tip is, m, and its way to the first row if the next motion begins so."""
        if (tip, approaches) != (self._tip, self._approaches):
            self._tip, self._approaches = tip, approaches
            self.update()

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self._renew()

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Change between the path and the whole reach."""
        if event.button() is Qt.MouseButton.LeftButton:
            self.whole = not self.whole
            self._renew()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw both views with their captions and one scale bar."""
        path = self._path
        if path is None:
            return
        if self._drawn is None or self._drawn.deviceIndependentSize().toSize() != self.size():
            self._drawn = self._draw(path)
        painter = QPainter(self)
        painter.drawPixmap(0, 0, self._drawn)
        if self._tip is not None:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            for frame in self._frames:
                self._draw_tip(painter, path, frame, np.array(self._tip))
        painter.end()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw again in another font or style."""
        super().changeEvent(event)
        self._renew()

    def _renew(self) -> None:
        self._drawn = None
        self.update()

    def _draw(self, path: TipPath) -> QPixmap:
        """Return all of it as a picture: what stays is not drawn thirty times a second."""
        ratio = self.devicePixelRatioF()
        picture = QPixmap(self.size() * ratio)
        picture.setDevicePixelRatio(ratio)
        picture.fill(Qt.GlobalColor.transparent)
        low, high = self._bounds(path)
        middle, span = 0.5 * (low + high), high - low
        width, height = (self.width() - _GAP) / 2, self.height() - 2 * _CAPTION
        scale = min(width, height) / float(span.max())
        painter = QPainter(picture)
        painter.setFont(self.font())
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self._frames = []
        for left, up in ((0.0, 1), (width + _GAP, 2)):
            frame = TipFrame(QRectF(left, _CAPTION, width, height), middle, scale, up)
            self._frames.append(frame)
            self._draw_view(painter, path, frame)
            painter.setPen(QColor(self._theme.quiet))
            caption = tr("above: x, y") if up == 1 else tr("side: x, z")
            painter.drawText(QRectF(left, 0, width, _CAPTION), Qt.AlignmentFlag.AlignLeft, caption)
        draw_scale(painter, QRectF(self.rect()), scale, QColor(self._theme.text))
        painter.end()
        return picture

    def _bounds(self, path: TipPath) -> tuple[FloatArray, FloatArray]:
        """Return the corners (3,) of what is shown, m."""
        if self.whole:
            reach = Workspace.of(path.zone.chain).hull
            low, high = reach.low, reach.high
        else:
            seen = np.vstack((path.now, self._rows))
            low, high = seen.min(axis=0), seen.max(axis=0)
        margin = max(_MARGIN * float((high - low).max()), _LEAST)
        return low - margin, high + margin

    def _draw_view(self, painter: QPainter, path: TipPath, frame: TipFrame) -> None:
        theme = self._theme
        painter.save()
        painter.setClipRect(frame.area)
        painter.fillRect(frame.area, QColor(theme.surface))
        red = QColor(theme.danger)
        red.setAlpha(60)
        painter.fillPath(forbidden(path.zone, frame), red)
        reach = Workspace.of(path.zone.chain).hull
        painter.setPen(QPen(QColor(theme.line), 1.0))
        painter.drawRect(QRectF(frame.point(reach.low), frame.point(reach.high)).normalized())
        painter.setPen(QPen(QColor(theme.accent), 1.5))
        painter.drawPolyline(frame.points(self._rows))
        painter.setPen(QPen(QColor(theme.danger_text), 3.0))
        painter.drawPoints(frame.points(self._rows[self._out]))
        painter.restore()

    def _draw_tip(self, painter: QPainter, path: TipPath, frame: TipFrame, tip: FloatArray) -> None:
        painter.save()
        painter.setClipRect(frame.area)
        if self._approaches:
            painter.setPen(QPen(QColor(self._theme.quiet), 1.0, Qt.PenStyle.DashLine))
            painter.drawLine(frame.point(tip), frame.point(path.rows[0]))
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(self._theme.text))
        painter.drawEllipse(frame.point(tip), 3.0, 3.0)
        painter.restore()
