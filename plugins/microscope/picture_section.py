"""Display of the picture: levels, gamma, colours and overlays."""

from dataclasses import replace

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QCheckBox, QLabel, QSlider

from rotemina.app.language import translate_message
from rotemina.app.microscope import MicroscopeStatus
from rotemina.app.settings import UserSettings
from rotemina.app.widgets.controls import (
    WheelSafeComboBox,
    make_button,
    make_tooltip,
    name_widget,
)
from rotemina.app.widgets.layout import Section
from rotemina.app.widgets.style import Theme
from rotemina.plugins.microscope import tr
from rotemina.plugins.microscope.contrast import (
    GAMMA_RANGE,
    ColourTable,
    ContrastSettings,
    compute_histogram,
)
from rotemina.plugins.microscope.histogram_view import HistogramView
from rotemina.plugins.microscope.overlays import OverlayLayer
from rotemina.plugins.microscope.picture_view import PictureView

# Number of steps of the slider. Each step changes gamma by the same factor.
_GAMMA_STEP_COUNT = 100.0


class PictureSection(Section):
    """Section with automatic or manual contrast, and the histogram."""

    def __init__(self, view: PictureView, theme: Theme) -> None:
        super().__init__(tr("Contrast"))
        self._view = view
        self.histogram = HistogramView(theme)
        self.histogram.moved.connect(self._set_levels)
        self.auto = QCheckBox(tr("automatic levels"))
        self.auto.setToolTip(make_tooltip(tr("Black and white at 0.1 and 99.9 % of the pixels")))
        self.auto.setChecked(True)
        self.auto.toggled.connect(lambda on: self._change_contrast(auto=on))
        self.full_range_button = make_button(tr("Full range"), lambda: self._set_levels(0.0, 1.0))
        self.full_range_button.setToolTip(
            make_tooltip(tr("Black at 0, white at the largest number"))
        )
        self.gamma = name_widget(QSlider(Qt.Orientation.Horizontal), tr("Gamma"))
        self.gamma.setRange(0, int(_GAMMA_STEP_COUNT))
        self.gamma.setValue(int(_GAMMA_STEP_COUNT / 2))
        self.gamma.valueChanged.connect(
            lambda step: self._change_contrast(gamma=_compute_gamma(step))
        )
        self._gamma_text = QLabel()
        self.table = WheelSafeComboBox(tr("Colours"), letters=6)
        for table in ColourTable:
            self.table.addItem(translate_message(table), table)
        self.table.currentIndexChanged.connect(
            lambda _: self._change_contrast(table=self.table.currentData())
        )
        self.column.addWidget(self.histogram)
        self.column.addWidget(self.auto)
        self.column.addWidget(self.full_range_button)
        self.add_row(self._gamma_text, self.gamma)
        self.column.addWidget(self.table)
        self._change_contrast()

    def refresh(self, status: MicroscopeStatus) -> None:
        """Show the histogram of the newest picture."""
        if status.feed.frame is not None:
            self.histogram.show_counts(compute_histogram(status.feed.frame), self._view.span)

    def set_theme(self, theme: Theme) -> None:
        """Use the colours of a theme."""
        self.histogram.theme = theme
        self.histogram.update()

    def _set_levels(self, low: float, high: float) -> None:
        self.auto.blockSignals(True)
        self.auto.setChecked(False)
        self.auto.blockSignals(False)
        self._change_contrast(auto=False, low=low, high=high)

    def _change_contrast(self, **changes: object) -> None:
        contrast: ContrastSettings = replace(self._view.contrast, **changes)  # type: ignore[arg-type]
        if changes.get("auto") is False and "low" not in changes:
            # Manual levels start from the automatic ones.
            low, high = self._view.span
            contrast = replace(contrast, low=low, high=high)
        self._view.set_contrast(contrast)
        self._gamma_text.setText(tr("gamma {gamma:.2f}").format(gamma=contrast.gamma))
        tooltip = tr("{low:g} to {high:g}; 1: linear; smaller values brighten dark regions")
        self.gamma.setToolTip(make_tooltip(tooltip.format(low=GAMMA_RANGE[0], high=GAMMA_RANGE[1])))


class LayerSection(Section):
    """Section with a check box for each layer over the picture."""

    def __init__(self, view: PictureView, settings: UserSettings) -> None:
        super().__init__(tr("Over the picture"))
        self.boxes: dict[OverlayLayer, QCheckBox] = {}
        for layer in OverlayLayer:
            box = QCheckBox(translate_message(layer))
            box.setToolTip(
                make_tooltip(
                    tr("Show over the picture: {layer}").format(layer=translate_message(layer))
                )
            )
            key = f"microscope.layer.{layer.name.lower()}"
            box.setChecked(bool(settings.get(key, layer in view.layers)))
            view.set_layer(layer, box.isChecked())
            box.toggled.connect(lambda on, layer=layer: view.set_layer(layer, on))
            box.toggled.connect(lambda on, key=key: settings.set(key, on))
            self.boxes[layer] = box
            self.column.addWidget(box)


def _compute_gamma(step: int) -> float:
    low, high = GAMMA_RANGE
    return float(low * (high / low) ** (step / _GAMMA_STEP_COUNT))
