"""The time of a recording as a slider, with marks for its events."""

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QMouseEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QSlider, QStyle, QStyleOptionSlider

from rotemina.app.language import translate
from rotemina.app.records import EventSeverity, TimelineEvent
from rotemina.app.widgets.style import Theme

_MARK_HEIGHT_PX = 5
# The most severe mark is drawn last, on top.
_DRAWING_ORDER = (EventSeverity.REMARK, EventSeverity.WARNING, EventSeverity.GRAVE)


class ReplayTimeline(QSlider):
    """Slider in milliseconds; a click anywhere on it jumps there."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        self._theme = theme
        self._marks: tuple[TimelineEvent, ...] = ()
        self.setAccessibleName(translate("shell", "Time of the replay"))
        self.setSingleStep(1000)
        self.setPageStep(10_000)
        self.setMinimumHeight(22 + _MARK_HEIGHT_PX)

    def show_recording(self, duration_s: float, marks: Sequence[TimelineEvent]) -> None:
        """Show another recording and mark its events."""
        self._marks = tuple(marks)
        self.setRange(0, round(1000.0 * duration_s))
        self.update()

    def use_theme(self, theme: Theme) -> None:
        """Change the colours."""
        self._theme = theme
        self.update()

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Jump to the clicked position; the handle can then be dragged from there."""
        if event.button() is Qt.MouseButton.LeftButton:
            handle_width = self._find_handle_width()
            position = round(event.position().x()) - handle_width // 2
            span = self.width() - handle_width
            low, high = self.minimum(), self.maximum()
            self.setValue(QStyle.sliderValueFromPosition(low, high, position, span))
        super().mousePressEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the slider, and the marks along its upper edge."""
        super().paintEvent(event)
        painter = QPainter(self)
        handle_width = self._find_handle_width()
        colours = {
            EventSeverity.GRAVE: self._theme.danger_text,
            EventSeverity.WARNING: self._theme.warning,
            EventSeverity.REMARK: self._theme.accent,
        }
        for severity in _DRAWING_ORDER:
            positions = {
                QStyle.sliderPositionFromValue(
                    self.minimum(),
                    self.maximum(),
                    round(1e3 * event_mark.at_s),
                    self.width() - handle_width,
                )
                for event_mark in self._marks
                if event_mark.severity is severity
            }
            for mark_position in positions:
                colour = QColor(colours[severity])
                painter.fillRect(
                    mark_position + handle_width // 2 - 1, 0, 2, _MARK_HEIGHT_PX, colour
                )
        painter.end()

    def _find_handle_width(self) -> int:
        option = QStyleOptionSlider()
        self.initStyleOption(option)
        return self.style().pixelMetric(QStyle.PixelMetric.PM_SliderLength, option, self)
