"""The legend: each line drawn as it is in the plots, with its name."""

from collections.abc import Sequence
from typing import NamedTuple

from PySide6.QtCore import QLineF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.shell.plot import BAND, Line
from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.controls import plain_tip

_SAMPLE, _NEAR, _APART = 26, 5, 14  # px: of a line, from it to its name, and to the next


class Entry(NamedTuple):
    """A name with its line; None: the band of the noise floor."""

    name: str
    line: Line | None


class Legend(QWidget):
    """One row of lines and names, or of a text in their place; what has no room is cut."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._entries: Sequence[Entry] = ()
        self._text = ""
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def text(self) -> str:
        """Return what is said: the names, or the text in their place."""
        return self._text or " · ".join(entry.name for entry in self._entries)

    def show_entries(self, entries: Sequence[Entry], theme: Theme) -> None:
        """Show lines with their names."""
        self._theme, self._entries = theme, entries
        self.show_text("")

    def show_text(self, text: str) -> None:
        """Show a text in place of the lines; "" brings them back."""
        self._text = text
        self.setAccessibleName(self.text())
        self.setToolTip(plain_tip(self.text()))
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Ask for one line of text, of any width."""
        return QSize(1, self.fontMetrics().height() + 2)

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw lines and names from the left."""
        painter, room = QPainter(self), QRectF(self.rect())
        painter.setPen(QColor(self._theme.text))
        centred = int(Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft)
        if self._text:
            painter.drawText(room, centred, self._text)
            painter.end()
            return
        middle, at = room.center().y(), 2.0
        for entry in self._entries:
            self._draw_sample(painter, entry.line, QRectF(at, middle - 5, _SAMPLE, 10))
            at += _SAMPLE + _NEAR
            painter.setPen(QColor(self._theme.text))
            painter.drawText(QRectF(at, 0, room.width(), room.height()), centred, entry.name)
            at += painter.fontMetrics().horizontalAdvance(entry.name) + _APART
        painter.end()

    def _draw_sample(self, painter: QPainter, line: Line | None, room: QRectF) -> None:
        if line is None:
            band = QColor(self._theme.text)
            band.setAlphaF(BAND)
            painter.fillRect(room, band)
            return
        middle = room.center().y()
        painter.setPen(QPen(QColor(getattr(self._theme, line.role)), line.width, line.style))
        painter.drawLine(QLineF(room.left(), middle, room.right(), middle))
