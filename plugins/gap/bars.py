"""Bars that shrink: sizes on a logarithmic scale, beside lines that they cannot pass."""

import math
from collections.abc import Sequence
from typing import NamedTuple

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.shell.language import translate
from rotemina.app.shell.theme import Theme
from rotemina.plugins.gap.tips import tip

_ROW = 24  # at most, high
_GAP = 6
_ROOM = 8  # beside texts


class Bar(NamedTuple):
    """A size (above 0), its name and how it is written; ``role`` is a colour of the theme."""

    name: str
    size: float
    text: str
    role: str


class Bars(QWidget):
    """Bars one below the other; ``lines`` stand upright across all of them."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.bars: tuple[Bar, ...] = ()
        self.lines: tuple[Bar, ...] = ()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return the room in which everything can be read."""
        return QSize(360, _ROW * (len(self.bars) + 1))

    def show_bars(self, bars: Sequence[Bar], lines: Sequence[Bar]) -> None:
        """Draw bars and lines in place of the last."""
        self.bars, self.lines = tuple(bars), tuple(lines)
        told = [f"{bar.name} {bar.text}" for bar in (*bars, *lines)]
        self.setAccessibleName(translate("gap", "Gap: {bars}").format(bars=", ".join(told)))
        self.setToolTip(tip(*told))
        self.update()

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw names on the left, bars with their texts, and lines with theirs below."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(self._theme.surface))
        if not self.bars:
            return
        metrics = self.fontMetrics()
        left = max(metrics.horizontalAdvance(bar.name) for bar in self.bars) + _ROOM
        right = max(metrics.horizontalAdvance(bar.text) for bar in self.bars) + 2 * _ROOM
        width = max(self.width() - left - right, 20)
        height = min((self.height() - metrics.height() - _GAP) / len(self.bars), _ROW)
        low, high = self._scale()
        for row, bar in enumerate(self.bars):
            place = QRectF(left, row * height + 2, _share(bar.size, low, high) * width, height - 4)
            self._draw_bar(painter, bar, place, left)
        bottom = height * len(self.bars)
        at = left
        for line in self.lines:
            x = left + _share(line.size, low, high) * width
            painter.setPen(QPen(QColor(getattr(self._theme, line.role)), 2, Qt.PenStyle.DashLine))
            painter.drawLine(round(x), 0, round(x), round(bottom))
            text = f"┆ {line.name} {line.text}"
            painter.drawText(round(at), round(bottom + metrics.ascent() + 2), text)
            at += metrics.horizontalAdvance(text) + 2 * _ROOM

    def _draw_bar(self, painter: QPainter, bar: Bar, place: QRectF, left: float) -> None:
        painter.fillRect(place, QColor(getattr(self._theme, bar.role)))
        painter.setPen(QColor(self._theme.text))
        across = Qt.AlignmentFlag.AlignVCenter
        name = QRectF(0, place.top(), left - _ROOM, place.height())
        painter.drawText(name, across | Qt.AlignmentFlag.AlignRight, bar.name)
        behind = QRectF(place.right() + _ROOM, place.top(), 400, place.height())
        painter.drawText(behind, across | Qt.AlignmentFlag.AlignLeft, bar.text)

    def _scale(self) -> tuple[float, float]:
        """Return what stands at no length and at full length."""
        sizes = [bar.size for bar in (*self.bars, *self.lines) if bar.size > 0.0] or [1.0]
        return 0.6 * min(sizes), max(sizes)


def _share(size: float, low: float, high: float) -> float:
    if size <= low:
        return 0.0
    return math.log(size / low) / math.log(high / low)
