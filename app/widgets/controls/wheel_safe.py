"""Combo boxes, sliders and number fields that ignore the mouse wheel.

The wheel scrolls the panel, and must not change a control that happens to be under the pointer.
"""

from PySide6.QtCore import Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QComboBox, QDoubleSpinBox, QSlider

from rotemina.app.widgets.controls.controls import make_tooltip


class WheelSafeMixin:
    """Mixin that leaves wheel events to the scroll area; list it before Qt's class."""

    def wheelEvent(self, event: QWheelEvent) -> None:  # noqa: N802 (Qt's name)
        """Leave the wheel to the scroll area."""
        event.ignore()


class WheelSafeComboBox(WheelSafeMixin, QComboBox):
    """Combo box that the wheel does not change.

    Its tooltip is its name, unless ``tip`` is given. With ``letters`` it may become as narrow as
    that many letters; otherwise it has space for its longest text.
    """

    def __init__(self, name: str = "", *tip: str, letters: int | None = None) -> None:
        super().__init__()
        self.setAccessibleName(name)
        if name:
            self.setToolTip(make_tooltip(*(tip or (name,))))
        if letters is not None:
            policies = QComboBox.SizeAdjustPolicy
            self.setSizeAdjustPolicy(policies.AdjustToMinimumContentsLengthWithIcon)
            self.setMinimumContentsLength(letters)

    def select(self, value: object) -> None:
        """Select the entry with a value, or none if there is no such entry."""
        index = self.findData(value)
        if index != self.currentIndex():
            self.setCurrentIndex(index)


class WheelSafeSlider(WheelSafeMixin, QSlider):
    """Slider from 0 to ``steps`` that the wheel does not move."""

    def __init__(self, name: str, steps: int) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        self.setRange(0, steps)
        self.setAccessibleName(name)


class WheelSafeSpinBox(WheelSafeMixin, QDoubleSpinBox):
    """Number field that the wheel does not change."""
