"""The histogram of the picture, with two handles for the black and the white level."""

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QMouseEvent, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.shell.theme import Theme
from rotemina.plugins.microscope import tr
from rotemina.plugins.microscope.contrast import BINS

_HANDLE = 6.0  # px to each side that take hold of a handle
_LEAST = 1.0 / BINS  # between the handles


class HistogramView(QWidget):
    """Draws counts of 256 bins by their logarithm.

    Signals
    -------
    moved(float, float) : the levels that a hand has set, shares of the largest number.
    """

    moved = Signal(float, float)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.theme = theme
        self.counts = np.zeros(BINS, dtype=np.int64)
        self.span = (0.0, 1.0)
        self._held: int | None = None
        self.setMinimumHeight(70)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setAccessibleName(tr("Histogram with the levels of black and white"))
        self.setToolTip(tr("Drag a handle to set the black or the white level"))

    def show_counts(self, counts: np.ndarray, span: tuple[float, float]) -> None:
        """Show another picture's; a handle that is held stays."""
        self.counts = counts
        if self._held is None:
            self.span = span
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Ask for some width, and its height."""
        return QSize(200, 70)

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw counts and handles."""
        painter = QPainter(self)
        area = QRectF(self.rect())
        painter.fillRect(area, QColor(self.theme.raised))
        heights = np.log1p(self.counts)
        top = float(heights.max()) or 1.0
        points = [
            QPointF(area.width() * (number + 0.5) / BINS, area.height() * (1.0 - 0.95 * high / top))
            for number, high in enumerate(heights.tolist())
        ]
        ends = QPointF(area.width(), area.height()), QPointF(0.0, area.height())
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(self.theme.command))
        painter.drawPolygon(QPolygonF([ends[1], *points, ends[0]]))
        for level in self.span:
            x = min(max(level * area.width(), 1.0), area.width() - 1.0)
            painter.setPen(QPen(QColor(self.theme.accent), 2.0))
            painter.drawLine(QPointF(x, 0.0), QPointF(x, area.height()))
            painter.setBrush(QColor(self.theme.accent))
            painter.drawEllipse(QPointF(x, area.height() - 6.0), 4.0, 4.0)
        painter.end()

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Take hold of the nearer handle."""
        level = event.position().x() / self.width()
        off = [abs(one - level) for one in self.span]
        nearer = 0 if off[0] < off[1] else 1
        if off[0] == off[1]:  # one upon the other: the one on the way to where it is pulled
            nearer = 0 if level < self.span[0] else 1
        if off[nearer] * self.width() <= _HANDLE:
            self._held = nearer

    def mouseMoveEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Move the handle, but not past the other."""
        if self._held is None:
            return
        level, (low, high) = event.position().x() / self.width(), self.span
        if self._held == 0:
            low = min(max(level, 0.0), high - _LEAST)
        else:
            high = max(min(level, 1.0), low + _LEAST)
        self.span = (low, high)
        self.moved.emit(low, high)
        self.update()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Release it."""
        self._held = None
