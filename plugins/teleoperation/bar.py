"""A bar from its middle: how far a stick is moved, or how hard a contact pushes back."""

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.shell.workbench import Workbench


class CentreBar(QWidget):
    """A value of −1 to 1, drawn from the middle; none is drawn as a dashed line.

    Parameters
    ----------
    workbench : Workbench
        For its colours.
    colour : str
        The theme's role of the filled part.
    """

    def __init__(self, workbench: Workbench, colour: str = "accent") -> None:
        super().__init__()
        self.value: float | None = None
        self._stale = False
        self._workbench, self._colour = workbench, colour
        self.setFixedHeight(10)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def show_value(self, value: float | None, *, stale: bool = False) -> None:
        """Draw another value."""
        if (value, stale) != (self.value, self._stale):
            self.value, self._stale = value, stale
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the line, the value, and the middle."""
        theme = self._workbench.theme
        painter = QPainter(self)
        width, middle = self.width(), self.height() / 2
        if self.value is None:
            painter.setPen(QPen(QColor(theme.quiet), 1, Qt.PenStyle.DashLine))
            painter.drawLine(0, round(middle), width, round(middle))
        else:
            painter.fillRect(QRectF(0, middle - 2, width, 4), theme.line)
            share = 0.5 * width * min(max(self.value, -1.0), 1.0)
            filled = QRectF(0.5 * width, middle - 3, share, 6).normalized()
            painter.fillRect(filled, theme.quiet if self._stale else getattr(theme, self._colour))
        painter.fillRect(QRectF(0.5 * width - 1, 0, 2, self.height()), theme.text)
        painter.end()
