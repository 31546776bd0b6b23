"""Sliders over the range of motion, and choices of the view."""

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QCheckBox, QComboBox, QLabel, QWidget

from rotemina.app.display_units import label
from rotemina.app.widgets.controls import named
from rotemina.app.widgets.layouts import in_grid
from rotemina.app.widgets.wheel_safe import SteadySlider
from rotemina.plugins.plate import mark, tr
from rotemina.plugins.plate.coloured_quantities import QUANTITIES, Quantity
from rotemina.plugins.plate.words import AXES
from rotemina.sim.arrays import FloatArray
from rotemina.sim.quantities import fixed

_STEPS = 500
_SCALES = 200  # per cent
STATIC = mark("Moved hub")


class Controls(QWidget):
    """What is shown, and where the hub is.

    Signals
    -------
    changed() : something else is to be shown.
    """

    changed = Signal()

    def __init__(self) -> None:
        super().__init__()
        self._ranges = np.zeros((3, 2))
        self.what = QComboBox()
        self.what.setAccessibleName(tr("View"))
        self.what.setToolTip(tr("The plate with its hub moved, or one of its modes"))
        self.colour = named(QComboBox(), tr("Colours"), tr("Quantity of the colours"))
        for quantity in QUANTITIES:
            self.colour.addItem(tr(quantity.title))
        self.sliders = tuple(
            SteadySlider(tr("{axis} of the hub").format(axis=label(name)), _STEPS)
            for name, _, _ in AXES
        )
        for slider, (name, unit, _) in zip(self.sliders, AXES, strict=True):
            text = tr("{axis} of the hub over its range, in {unit}")
            slider.setToolTip(text.format(axis=label(name), unit=unit))
        self.values = tuple(QLabel() for _ in AXES)
        self.scale = SteadySlider(tr("Scale of the deformation"), _SCALES)
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
            box.currentIndexChanged.connect(lambda _: self._change())
        for slider in (*self.sliders, self.scale):
            slider.valueChanged.connect(lambda _: self._change())
        self._change()

    def _lay_out(self) -> None:
        grid = in_grid(on=self, margins=0, spacing=(-1, 4), stretched=1)
        grid.addWidget(QLabel(tr("Show")), 0, 0)
        grid.addWidget(self.what, 0, 1, 1, 2)
        grid.addWidget(QLabel(tr("Colours")), 1, 0)
        grid.addWidget(self.colour, 1, 1, 1, 2)
        for row, ((name, _, _), slider, value) in enumerate(
            zip(AXES, self.sliders, self.values, strict=True), start=2
        ):
            grid.addWidget(QLabel(label(name)), row, 0)
            grid.addWidget(slider, row, 1)
            grid.addWidget(value, row, 2)
        grid.addWidget(QLabel(tr("Scale")), 5, 0)
        grid.addWidget(self.scale, 5, 1)
        grid.addWidget(self.scale_text, 5, 2)
        grid.addWidget(self.mesh, 6, 1)
        for value in (*self.values, self.scale_text):
            value.setTextFormat(Qt.TextFormat.PlainText)
            value.setMinimumWidth(86)
            value.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        grid.setRowStretch(7, 1)

    def offer(self, ranges: FloatArray, modes: list[str]) -> None:
        """Offer the range of motion (3, 2) and the modes of a solved plate."""
        first = not self._ranges.any()
        self._ranges = ranges
        for slider, ends, (name, unit, per_si) in zip(self.sliders, ranges, AXES, strict=True):
            low, high = per_si * ends
            text = tr("{axis} of the hub, {low:.4g} to {high:.4g} {unit}")
            slider.setToolTip(text.format(axis=label(name), low=low, high=high, unit=unit))
        chosen = max(self.what.currentIndex(), 0)
        self.what.blockSignals(True)
        self.what.clear()
        mode = tr("Mode {title}")
        self.what.addItem(tr(STATIC))
        self.what.addItems([mode.format(title=title) for title in modes])
        self.what.setCurrentIndex(min(chosen, len(modes)))
        self.what.blockSignals(False)
        if first:
            for slider in self.sliders:
                slider.setValue(_STEPS)
        self._change()

    @property
    def pose(self) -> FloatArray:
        """Where the hub is: zn m, thx rad, thy rad."""
        shares = np.array([slider.value() / _STEPS for slider in self.sliders])
        return np.asarray(self._ranges[:, 0] + shares * np.ptp(self._ranges, axis=1))

    @property
    def mode(self) -> int | None:
        """The number of the mode that is shown, from 0, or None for the hub moved."""
        index = self.what.currentIndex() - 1
        return index if index >= 0 else None

    @property
    def quantity(self) -> Quantity:
        """What the colours mean."""
        return QUANTITIES[self.colour.currentIndex()]

    @property
    def magnification(self) -> float:
        """How high the deformation is drawn; 1 is well visible, 0 flat."""
        return self.scale.value() / 100.0

    def _change(self) -> None:
        for value, text, (_, unit, per_si) in zip(self.values, self.pose, AXES, strict=True):
            value.setText(f"{fixed(per_si * text, 1)} {unit}")
        static = self.mode is None
        for widget in (*self.sliders, self.colour):
            # A slider's tooltip is its range: only whether it can be moved changes here.
            widget.setEnabled(static)
        self.changed.emit()
