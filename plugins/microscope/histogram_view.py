"""Histogram of the picture, with handles for the black and the white level."""

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QMouseEvent, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.widgets.style import Theme
from rotemina.plugins.microscope import tr
from rotemina.plugins.microscope.contrast import BIN_COUNT

_MAX_HANDLE_DISTANCE_PX = 6.0
# The handles stay at least one bin apart.
_MIN_LEVEL_SPAN = 1.0 / BIN_COUNT


class HistogramView(QWidget):
    """Histogram of 256 bins on a logarithmic scale, with two handles.

    Signals
    -------
    moved(float, float) : the operator has set these levels, relative to the largest pixel value.
    """

    moved = Signal(float, float)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.theme = theme
        self.counts = np.zeros(BIN_COUNT, dtype=np.int64)
        self.span = (0.0, 1.0)
        self._dragged_handle: int | None = None
        self.setMinimumHeight(70)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setAccessibleName(tr("Histogram with the levels of black and white"))
        self.setToolTip(tr("Drag a handle to set the black or the white level"))

    def show_counts(self, counts: np.ndarray, span: tuple[float, float]) -> None:
        """Show the counts of another picture. A handle that is being dragged stays in place."""
        self.counts = counts
        if self._dragged_handle is None:
            self.span = span
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return the preferred size."""
        return QSize(200, 70)

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the counts and the handles."""
        painter = QPainter(self)
        area = QRectF(self.rect())
        painter.fillRect(area, QColor(self.theme.raised))
        # The logarithm keeps rare pixel values visible next to frequent ones.
        log_counts = np.log1p(self.counts)
        max_log_count = float(log_counts.max()) or 1.0
        points = [
            QPointF(
                area.width() * (index + 0.5) / BIN_COUNT,
                area.height() * (1.0 - 0.95 * height / max_log_count),
            )
            for index, height in enumerate(log_counts.tolist())
        ]
        corners = QPointF(area.width(), area.height()), QPointF(0.0, area.height())
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(self.theme.command))
        painter.drawPolygon(QPolygonF([corners[1], *points, corners[0]]))
        for level in self.span:
            x = min(max(level * area.width(), 1.0), area.width() - 1.0)
            painter.setPen(QPen(QColor(self.theme.accent), 2.0))
            painter.drawLine(QPointF(x, 0.0), QPointF(x, area.height()))
            painter.setBrush(QColor(self.theme.accent))
            painter.drawEllipse(QPointF(x, area.height() - 6.0), 4.0, 4.0)
        painter.end()

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Begin to drag the nearer handle, if it is close enough."""
        level = event.position().x() / self.width()
        distances = [abs(handle - level) for handle in self.span]
        nearer = 0 if distances[0] < distances[1] else 1
        # If the handles coincide, the side of the press decides which one is dragged.
        if distances[0] == distances[1]:
            nearer = 0 if level < self.span[0] else 1
        if distances[nearer] * self.width() <= _MAX_HANDLE_DISTANCE_PX:
            self._dragged_handle = nearer

    def mouseMoveEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Move the dragged handle, but not past the other one."""
        if self._dragged_handle is None:
            return
        level, (low, high) = event.position().x() / self.width(), self.span
        if self._dragged_handle == 0:
            low = min(max(level, 0.0), high - _MIN_LEVEL_SPAN)
        else:
            high = max(min(level, 1.0), low + _MIN_LEVEL_SPAN)
        self.span = (low, high)
        self.moved.emit(low, high)
        self.update()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """End the drag."""
        self._dragged_handle = None
