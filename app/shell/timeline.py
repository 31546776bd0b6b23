"""The time of a recording as a slider, with a mark where something happened."""

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QMouseEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QSlider, QStyle, QStyleOptionSlider

from rotemina.app.recorded_events import Severity, TimelineEvent
from rotemina.app.shell.language import translate
from rotemina.app.shell.theme import Theme

_MARK_HEIGHT = 5
_ORDER = (Severity.REMARK, Severity.WARNING, Severity.GRAVE)  # the gravest is drawn last, on top


class Timeline(QSlider):
    """A slider in milliseconds; a click anywhere on it jumps there."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        self._theme = theme
        self._marks: tuple[TimelineEvent, ...] = ()
        self.setAccessibleName(translate("shell", "Time of the replay"))
        self.setSingleStep(1000)
        self.setPageStep(10_000)
        self.setMinimumHeight(22 + _MARK_HEIGHT)

    def show_recording(self, duration_s: float, marks: Sequence[TimelineEvent]) -> None:
        """Begin again with another recording and its events."""
        self._marks = tuple(marks)
        self.setRange(0, round(1000.0 * duration_s))
        self.update()

    def use_theme(self, theme: Theme) -> None:
        """Change the colours."""
        self._theme = theme
        self.update()

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Jump to where it was pressed; from there the handle can be dragged."""
        if event.button() is Qt.MouseButton.LeftButton:
            handle = self._handle_width()
            at = round(event.position().x()) - handle // 2
            span = self.width() - handle
            low, high = self.minimum(), self.maximum()
            self.setValue(QStyle.sliderValueFromPosition(low, high, at, span))
        super().mousePressEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the slider, and the marks along its upper edge."""
        super().paintEvent(event)
        painter = QPainter(self)
        handle = self._handle_width()
        colours = {
            Severity.GRAVE: self._theme.danger_text,
            Severity.WARNING: self._theme.warning,
            Severity.REMARK: self._theme.accent,
        }
        for weight in _ORDER:
            drawn = {
                QStyle.sliderPositionFromValue(
                    self.minimum(), self.maximum(), round(1e3 * one.at_s), self.width() - handle
                )
                for one in self._marks
                if one.weight is weight
            }
            for place in drawn:
                colour = QColor(colours[weight])
                painter.fillRect(place + handle // 2 - 1, 0, 2, _MARK_HEIGHT, colour)
        painter.end()

    def _handle_width(self) -> int:
        option = QStyleOptionSlider()
        self.initStyleOption(option)
        return self.style().pixelMetric(QStyle.PixelMetric.PM_SliderLength, option, self)
