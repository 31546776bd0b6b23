"""The legend: each line as it is drawn in the plots, with its name."""

from collections.abc import Sequence
from typing import NamedTuple

from PySide6.QtCore import QLineF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.widgets.drawing.plot import NOISE_BAND_ALPHA, LineStyle
from rotemina.app.widgets.style import Theme

# Length of a line, distance to its name, and distance to the next entry.
_SAMPLE_PX, _NAME_GAP_PX, _ENTRY_GAP_PX = 26, 5, 14


class LegendEntry(NamedTuple):
    """Name with its line style; None stands for the band of the noise floor."""

    name: str
    line: LineStyle | None


class PlotLegend(QWidget):
    """One row of lines and names, or a text instead of them; excess text is cut."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._entries: Sequence[LegendEntry] = ()
        self._text = ""
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def text(self) -> str:
        """Return the visible text: the names, or the text shown instead."""
        return self._text or " · ".join(entry.name for entry in self._entries)

    def show_entries(self, entries: Sequence[LegendEntry], theme: Theme) -> None:
        """Show lines with their names."""
        self._theme, self._entries = theme, entries
        self.show_text("")

    def show_text(self, text: str) -> None:
        """Show a text instead of the lines; "" shows the lines again."""
        self._text = text
        self.setAccessibleName(self.text())
        self.setToolTip(make_tooltip(self.text()))
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Request the height of one line of text and no particular width."""
        return QSize(1, self.fontMetrics().height() + 2)

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw lines and names from left to right."""
        painter, area = QPainter(self), QRectF(self.rect())
        painter.setPen(QColor(self._theme.text))
        alignment = int(Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft)
        if self._text:
            painter.drawText(area, alignment, self._text)
            painter.end()
            return
        centre_y, x = area.center().y(), 2.0
        for entry in self._entries:
            self._draw_sample(painter, entry.line, QRectF(x, centre_y - 5, _SAMPLE_PX, 10))
            x += _SAMPLE_PX + _NAME_GAP_PX
            painter.setPen(QColor(self._theme.text))
            painter.drawText(QRectF(x, 0, area.width(), area.height()), alignment, entry.name)
            x += painter.fontMetrics().horizontalAdvance(entry.name) + _ENTRY_GAP_PX
        painter.end()

    def _draw_sample(self, painter: QPainter, line: LineStyle | None, area: QRectF) -> None:
        if line is None:
            band_colour = QColor(self._theme.text)
            band_colour.setAlphaF(NOISE_BAND_ALPHA)
            painter.fillRect(area, band_colour)
            return
        centre_y = area.center().y()
        painter.setPen(QPen(QColor(getattr(self._theme, line.role)), line.width, line.style))
        painter.drawLine(QLineF(area.left(), centre_y, area.right(), centre_y))
