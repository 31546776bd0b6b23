"""A reading that shows its age, and the bar of a range."""

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QBrush, QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import QLabel, QSizePolicy, QWidget

from rotemina.app.shell.language import translate
from rotemina.app.shell.workbench import Workbench
from rotemina.plugins.control.parts import set_property
from rotemina.plugins.control.wording import LITTLE


class Readout(QLabel):
    """A large number; too old, it is grey and hatched."""

    def __init__(self, workbench: Workbench, name: str) -> None:
        super().__init__("–")
        self._workbench = workbench
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.setProperty("readout", True)
        self.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.setAccessibleName(name)

    def show_value(self, text: str, *, stale: bool) -> None:
        """Show another reading."""
        if text != self.text():
            self.setText(text)
        if bool(self.property("stale")) != stale:
            set_property(self, "stale", stale)
            self.setAccessibleDescription(translate("control", "old") if stale else "")
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the number, over its hatching."""
        if self.property("stale"):
            painter = QPainter(self)
            painter.fillRect(
                self.rect(),
                QBrush(QColor(self._workbench.theme.line), Qt.BrushStyle.BDiagPattern),
            )
            painter.end()
        super().paintEvent(event)


class RangeBar(QWidget):
    """Where an axis is within its range: a line with a mark for its command and its position.

    Ticks mark where little of the range is left; the stretch warns beyond them.
    """

    def __init__(self, workbench: Workbench, axis: str) -> None:
        super().__init__()
        self._workbench = workbench
        self._low, self._high = workbench.robot.axes[axis].range
        self._position: float | None = None
        self._command: float | None = None
        self._stale = False
        self.setFixedHeight(9)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def show_position(self, position: float | None, command: float | None, *, stale: bool) -> None:
        """Move the marks; None hides one."""
        shown = (position, command, stale)
        if shown != (self._position, self._command, self._stale):
            self._position, self._command, self._stale = shown
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the range, the stretch up to the position, and the command's mark."""
        theme = self._workbench.theme
        painter = QPainter(self)
        width, middle = self.width(), self.height() / 2
        painter.fillRect(QRectF(0, middle - 2, width, 4), QColor(theme.line))
        if self._position is not None:
            share = self._share(self._position)
            near = min(share, 1.0 - share) < LITTLE
            role = theme.quiet if self._stale else theme.warning if near else theme.real
            painter.fillRect(QRectF(0, middle - 2, width * share, 4), QColor(role))
        for end in (LITTLE, 1.0 - LITTLE):
            painter.fillRect(QRectF(width * end, middle - 3, 1, 6), QColor(theme.quiet))
        if self._command is not None:
            at = (width - 2) * self._share(self._command)
            painter.fillRect(QRectF(at, 0, 2, self.height()), QColor(theme.text))
        painter.end()

    def _share(self, value: float) -> float:
        return min(max((value - self._low) / (self._high - self._low), 0.0), 1.0)
