"""A reading with its age, and a range bar."""

from collections.abc import Sequence

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QBrush, QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.display_units import axis_scale
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import set_property
from rotemina.app.widgets.labels import LiveLabel
from rotemina.app.widgets.when_dressed import WhenDressed
from rotemina.plugins.control import tr
from rotemina.plugins.control.wording import LITTLE


class Readout(LiveLabel):
    """A large number; too old, it is grey and hatched."""

    def __init__(self, workbench: Workbench, name: str) -> None:
        super().__init__("–")
        self._workbench = workbench
        self.setProperty("readout", True)
        self.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.setAccessibleName(name)

    def show_value(self, text: str, *, stale: bool) -> None:
        """Show another reading."""
        if text != self.text():
            self.setText(text)
        if bool(self.property("stale")) != stale:
            set_property(self, "stale", stale)
            self.setAccessibleDescription(tr("outdated") if stale else "")
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the number, over its hatching."""
        if self.property("stale"):
            painter = QPainter(self)
            painter.fillRect(
                self.rect(), QBrush(QColor(self._workbench.theme.line), Qt.BrushStyle.BDiagPattern)
            )
            painter.end()
        super().paintEvent(event)


class RangeBar(QWidget):
    """Where an axis is within its range: a line with a mark for its command and its position.

    Ticks mark where little of the range is left; the stretch warns beyond them. What the tip's
    bounds forbid is hatched. With ``ends``, both ends are labelled.
    """

    def __init__(self, workbench: Workbench, axis: str) -> None:
        super().__init__()
        self._workbench = workbench
        self._low, self._high = workbench.robot.axes[axis].range
        self._position: float | None = None
        self._command: float | None = None
        self._stale = False
        self._forbidden: Sequence[tuple[float, float]] = ()
        scale = axis_scale(workbench.robot.axes[axis])
        rough = scale._replace(decimals=0)
        self.ends = rough.number(self._low), rough.text(self._high)
        self._labelled = False
        WhenDressed(self, self._fit)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def show_position(self, position: float | None, command: float | None, *, stale: bool) -> None:
        """Move the marks; None hides one."""
        shown = (position, command, stale)
        if shown != (self._position, self._command, self._stale):
            self._position, self._command, self._stale = shown
            self.update()

    def show_forbidden(self, stretches: Sequence[tuple[float, float]]) -> None:
        """Hatch stretches, m or rad."""
        if tuple(stretches) != tuple(self._forbidden):
            self._forbidden = stretches
            self.update()

    def label_ends(self, *, labelled: bool) -> None:
        """Write the ends of the range beside the bar, or leave them to the tooltip."""
        self._labelled = labelled
        self._fit()
        self.update()

    def _fit(self) -> None:
        self.setFixedHeight(self.fontMetrics().height() if self._labelled else 9)

    def track(self) -> QRectF:
        """Return where the range is drawn."""
        low, high = (self.fontMetrics().horizontalAdvance(end) + 6 for end in self.ends)
        if not self._labelled:
            low = high = 0
        return QRectF(low, 0, max(self.width() - low - high, 1), self.height())

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the range, the stretch up to the position, and the command's mark."""
        painter, track = QPainter(self), self.track()
        if self._labelled:
            painter.setPen(QColor(self._workbench.theme.quiet))
            sides = Qt.AlignmentFlag.AlignLeft, Qt.AlignmentFlag.AlignRight
            for end, side in zip(self.ends, sides, strict=True):
                painter.drawText(self.rect(), int(side | Qt.AlignmentFlag.AlignVCenter), end)
        painter.translate(track.left(), 0)
        self._draw(painter, track.width(), self.height() / 2)
        painter.end()

    def _draw(self, painter: QPainter, width: float, middle: float) -> None:
        theme = self._workbench.theme
        painter.fillRect(QRectF(0, middle - 2, width, 4), QColor(theme.line))
        hatch = QBrush(QColor(theme.danger_text), Qt.BrushStyle.BDiagPattern)
        for start, end in self._forbidden:
            left, right = (width * self._share(value) for value in (start, end))
            painter.fillRect(QRectF(left, middle - 4, right - left, 8), hatch)
        if self._position is not None:
            share = self._share(self._position)
            near = min(share, 1.0 - share) < LITTLE
            role = theme.quiet if self._stale else theme.warning if near else theme.real
            painter.fillRect(QRectF(0, middle - 2, width * share, 4), QColor(role))
        for end in (LITTLE, 1.0 - LITTLE):
            painter.fillRect(QRectF(width * end, middle - 3, 1, 6), QColor(theme.quiet))
        if self._command is not None:
            at = (width - 2) * self._share(self._command)
            painter.fillRect(QRectF(at, middle - 4, 2, 9), QColor(theme.text))

    def _share(self, value: float) -> float:
        return min(max((value - self._low) / (self._high - self._low), 0.0), 1.0)
