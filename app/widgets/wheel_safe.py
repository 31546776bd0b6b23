"""Choices, sliders and number fields that ignore the wheel.

A panel is scrolled by the wheel, and what lies under the pointer then must change no machine.
"""

from PySide6.QtCore import Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QComboBox, QDoubleSpinBox, QSlider

from rotemina.app.widgets.controls import plain_tip


class Steady:
    """A mixin that passes wheel events to the scroll area; precedes Qt's class."""

    def wheelEvent(self, event: QWheelEvent) -> None:  # noqa: N802 (Qt's name)
        """Leave the wheel to what scrolls."""
        event.ignore()


class SteadyChoice(Steady, QComboBox):
    """A choice that the wheel does not change.

    Its tooltip is its name, unless it has a ``tip`` of its own. With ``letters`` it may become as
    narrow as that many; otherwise it has room for its longest text.
    """

    def __init__(self, name: str = "", *tip: str, letters: int | None = None) -> None:
        super().__init__()
        self.setAccessibleName(name)
        if name:
            self.setToolTip(plain_tip(*(tip or (name,))))
        if letters is not None:
            policies = QComboBox.SizeAdjustPolicy
            self.setSizeAdjustPolicy(policies.AdjustToMinimumContentsLengthWithIcon)
            self.setMinimumContentsLength(letters)

    def select(self, value: object) -> None:
        """Show the text that stands for a value, or none where it is not offered."""
        index = self.findData(value)
        if index != self.currentIndex():
            self.setCurrentIndex(index)


class SteadySlider(Steady, QSlider):
    """A slider from 0 to ``steps`` that the wheel does not move."""

    def __init__(self, name: str, steps: int) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        self.setRange(0, steps)
        self.setAccessibleName(name)


class SteadyNumber(Steady, QDoubleSpinBox):
    """A number that the wheel does not change."""
