"""Readout of a position, and a bar that shows the position within its range."""

from collections.abc import Sequence

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QBrush, QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.language import choose_axis_scale
from rotemina.app.widgets.controls import set_property
from rotemina.app.widgets.style import OnStyleChange
from rotemina.app.widgets.text import LiveLabel
from rotemina.app.workbench import Workbench
from rotemina.plugins.control import tr
from rotemina.plugins.control.wording import NEAR_END_FRACTION


class PositionReadout(LiveLabel):
    """Large number that turns grey and hatched when it is out of date."""

    def __init__(self, workbench: Workbench, name: str) -> None:
        super().__init__("–")
        self._workbench = workbench
        self.setProperty("readout", True)
        self.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.setAccessibleName(name)

    def show_value(self, text: str, *, stale: bool) -> None:
        """Show a reading; a ``stale`` one is grey and hatched."""
        if text != self.text():
            self.setText(text)
        if bool(self.property("stale")) != stale:
            set_property(self, "stale", stale)
            self.setAccessibleDescription(tr("outdated") if stale else "")
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the number, over a hatching if the reading is out of date."""
        if self.property("stale"):
            painter = QPainter(self)
            painter.fillRect(
                self.rect(), QBrush(QColor(self._workbench.theme.line), Qt.BrushStyle.BDiagPattern)
            )
            painter.end()
        super().paintEvent(event)


class RangeBar(QWidget):
    """Bar over the range of an axis, filled up to the position, with a mark at the command.

    Two ticks bound the zones near the ends of the range. In these zones the bar is filled in the
    warning colour. Forbidden intervals are hatched. Both ends can be labelled.
    """

    def __init__(self, workbench: Workbench, axis: str) -> None:
        super().__init__()
        self._workbench = workbench
        self._low, self._high = workbench.robot.axes[axis].range
        self._position: float | None = None
        self._command: float | None = None
        self._stale = False
        self._forbidden: Sequence[tuple[float, float]] = ()
        scale = choose_axis_scale(workbench.robot.axes[axis])
        rounded_scale = scale._replace(decimals=0)
        self.end_texts = (
            rounded_scale.format_value(self._low),
            rounded_scale.format_with_unit(self._high),
        )
        self._labelled = False
        OnStyleChange(self, self._fit_height)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def show_position(self, position: float | None, command: float | None, *, stale: bool) -> None:
        """Show a position and a command, m or rad; None hides the one or the other."""
        new_values = (position, command, stale)
        if new_values != (self._position, self._command, self._stale):
            self._position, self._command, self._stale = new_values
            self.update()

    def show_forbidden(self, stretches: Sequence[tuple[float, float]]) -> None:
        """Hatch intervals (low, high), m or rad."""
        if tuple(stretches) != tuple(self._forbidden):
            self._forbidden = stretches
            self.update()

    def label_ends(self, *, labelled: bool) -> None:
        """Show the ends of the range next to the bar if ``labelled``."""
        self._labelled = labelled
        self._fit_height()
        self.update()

    def _fit_height(self) -> None:
        self.setFixedHeight(self.fontMetrics().height() if self._labelled else 9)

    def find_track(self) -> QRectF:
        """Return the rectangle in which the range is drawn."""
        left_margin, right_margin = (
            self.fontMetrics().horizontalAdvance(text) + 6 for text in self.end_texts
        )
        if not self._labelled:
            left_margin = right_margin = 0
        width = max(self.width() - left_margin - right_margin, 1)
        return QRectF(left_margin, 0, width, self.height())

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the range, the filling up to the position, and the mark at the command."""
        painter, track = QPainter(self), self.find_track()
        if self._labelled:
            painter.setPen(QColor(self._workbench.theme.quiet))
            sides = Qt.AlignmentFlag.AlignLeft, Qt.AlignmentFlag.AlignRight
            for text, side in zip(self.end_texts, sides, strict=True):
                painter.drawText(self.rect(), int(side | Qt.AlignmentFlag.AlignVCenter), text)
        painter.translate(track.left(), 0)
        self._draw_range(painter, track.width(), self.height() / 2)
        painter.end()

    def _draw_range(self, painter: QPainter, width: float, middle: float) -> None:
        theme = self._workbench.theme
        painter.fillRect(QRectF(0, middle - 2, width, 4), QColor(theme.line))
        hatch = QBrush(QColor(theme.danger_text), Qt.BrushStyle.BDiagPattern)
        for start, end in self._forbidden:
            left, right = (width * self._compute_fraction(value) for value in (start, end))
            painter.fillRect(QRectF(left, middle - 4, right - left, 8), hatch)
        if self._position is not None:
            fraction = self._compute_fraction(self._position)
            is_near_end = min(fraction, 1.0 - fraction) < NEAR_END_FRACTION
            colour = theme.quiet if self._stale else theme.warning if is_near_end else theme.real
            painter.fillRect(QRectF(0, middle - 2, width * fraction, 4), QColor(colour))
        for tick in (NEAR_END_FRACTION, 1.0 - NEAR_END_FRACTION):
            painter.fillRect(QRectF(width * tick, middle - 3, 1, 6), QColor(theme.quiet))
        if self._command is not None:
            mark_x = (width - 2) * self._compute_fraction(self._command)
            painter.fillRect(QRectF(mark_x, middle - 4, 2, 9), QColor(theme.text))

    def _compute_fraction(self, value: float) -> float:
        return min(max((value - self._low) / (self._high - self._low), 0.0), 1.0)
