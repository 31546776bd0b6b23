"""Controls of the panel: sliders over the range of motion, and choices of the view."""

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QCheckBox, QComboBox, QLabel, QWidget

from rotemina.app.language import get_axis_label
from rotemina.app.widgets.controls import WheelSafeSlider, name_widget
from rotemina.app.widgets.layout import make_grid
from rotemina.plugins.plate import mark, tr
from rotemina.plugins.plate.coloured_quantities import QUANTITIES, ColouredQuantity
from rotemina.plugins.plate.words import POSE_AXES
from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import format_fixed

_SLIDER_STEPS = 500
_MAX_SCALE_PERCENT = 200
STATIC_VIEW_TITLE = mark("Moved hub")


class PlateControls(QWidget):
    """Choices of the view and its colours, and sliders for the pose of the hub.

    Signals
    -------
    changed() : a choice or a slider has changed.
    """

    changed = Signal()

    def __init__(self) -> None:
        super().__init__()
        self._ranges = np.zeros((3, 2))
        self.what = QComboBox()
        self.what.setAccessibleName(tr("View"))
        self.what.setToolTip(tr("The plate with its hub moved, or one of its modes"))
        self.colour = name_widget(QComboBox(), tr("Colours"), tr("Quantity shown by the colours"))
        for quantity in QUANTITIES:
            self.colour.addItem(tr(quantity.title))
        self.sliders = tuple(
            WheelSafeSlider(
                tr("{axis} of the hub").format(axis=get_axis_label(name)), _SLIDER_STEPS
            )
            for name, _, _ in POSE_AXES
        )
        for slider, (name, unit, _) in zip(self.sliders, POSE_AXES, strict=True):
            text = tr("{axis} of the hub over its range, in {unit}")
            slider.setToolTip(text.format(axis=get_axis_label(name), unit=unit))
        self.values = tuple(QLabel() for _ in POSE_AXES)
        self.scale = WheelSafeSlider(tr("Scale of the deformation"), _MAX_SCALE_PERCENT)
        self.scale.setValue(100)
        self.scale_text = QLabel()
        self.scale.setToolTip(
            tr("Scale of the drawn deformation, 0 to 200 %; 100 % is well visible")
        )
        self.mesh = QCheckBox(tr("Mesh lines"))
        self.mesh.setToolTip(tr("Draw the edges of the elements"))
        self._lay_out()
        for box in (self.what, self.colour):
            box.setSizeAdjustPolicy(
                QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
            )
            box.setMinimumContentsLength(14)
            box.currentIndexChanged.connect(lambda _: self._on_changed())
        for slider in (*self.sliders, self.scale):
            slider.valueChanged.connect(lambda _: self._on_changed())
        self._on_changed()

    def _lay_out(self) -> None:
        grid = make_grid(on=self, margins=0, spacing=(-1, 4), stretched=1)
        grid.addWidget(QLabel(tr("Show")), 0, 0)
        grid.addWidget(self.what, 0, 1, 1, 2)
        grid.addWidget(QLabel(tr("Colours")), 1, 0)
        grid.addWidget(self.colour, 1, 1, 1, 2)
        for row, ((name, _, _), slider, value) in enumerate(
            zip(POSE_AXES, self.sliders, self.values, strict=True), start=2
        ):
            grid.addWidget(QLabel(get_axis_label(name)), row, 0)
            grid.addWidget(slider, row, 1)
            grid.addWidget(value, row, 2)
        grid.addWidget(QLabel(tr("Scale")), 5, 0)
        grid.addWidget(self.scale, 5, 1)
        grid.addWidget(self.scale_text, 5, 2)
        grid.addWidget(self.mesh, 6, 1)
        for label in (*self.values, self.scale_text):
            label.setTextFormat(Qt.TextFormat.PlainText)
            label.setMinimumWidth(86)
            label.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        grid.setRowStretch(7, 1)

    def offer_solution(self, ranges: FloatArray, modes: list[str]) -> None:
        """Offer the range of motion (3, 2), SI, and the modes of a solved plate."""
        is_first_solution = not self._ranges.any()
        self._ranges = ranges
        for slider, ends, (name, unit, per_si) in zip(self.sliders, ranges, POSE_AXES, strict=True):
            low, high = per_si * ends
            text = tr("{axis} of the hub, {low:.4g} to {high:.4g} {unit}")
            slider.setToolTip(text.format(axis=get_axis_label(name), low=low, high=high, unit=unit))
        view_index = max(self.what.currentIndex(), 0)
        self.what.blockSignals(True)
        self.what.clear()
        template = tr("Mode {title}")
        self.what.addItem(tr(STATIC_VIEW_TITLE))
        self.what.addItems([template.format(title=title) for title in modes])
        self.what.setCurrentIndex(min(view_index, len(modes)))
        self.what.blockSignals(False)
        if is_first_solution:
            for slider in self.sliders:
                slider.setValue(_SLIDER_STEPS)
        self._on_changed()

    @property
    def pose(self) -> FloatArray:
        """Pose of the hub: zn in m, thx and thy in rad."""
        fractions = np.array([slider.value() / _SLIDER_STEPS for slider in self.sliders])
        return np.asarray(self._ranges[:, 0] + fractions * np.ptp(self._ranges, axis=1))

    @property
    def mode(self) -> int | None:
        """Index of the shown mode, or None if the moved hub is shown."""
        index = self.what.currentIndex() - 1
        return index if index >= 0 else None

    @property
    def quantity(self) -> ColouredQuantity:
        """Quantity that the colours show."""
        return QUANTITIES[self.colour.currentIndex()]

    @property
    def magnification(self) -> float:
        """Scale of the drawn deformation. At 1 it is clearly visible, at 0 the plate is flat."""
        return self.scale.value() / 100.0

    def _on_changed(self) -> None:
        for label, coordinate, (_, unit, per_si) in zip(
            self.values, self.pose, POSE_AXES, strict=True
        ):
            label.setText(f"{format_fixed(per_si * coordinate, 1)} {unit}")
        is_hub_shown = self.mode is None
        for widget in (*self.sliders, self.colour):
            # The tooltip of a slider shows its range and must stay.
            widget.setEnabled(is_hub_shown)
        self.changed.emit()
