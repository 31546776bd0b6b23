"""Display of the picture: levels, gamma, colours, and overlays."""

from dataclasses import replace

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QCheckBox, QLabel, QSlider

from rotemina.app.microscope.status import MicroscopeStatus
from rotemina.app.settings import Settings
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.controls import button, named, plain_tip
from rotemina.app.widgets.section import Section
from rotemina.app.widgets.wheel_safe import SteadyChoice
from rotemina.plugins.microscope import tr
from rotemina.plugins.microscope.contrast import GAMMA, Contrast, Table, histogram
from rotemina.plugins.microscope.histogram_view import HistogramView
from rotemina.plugins.microscope.overlays import Layer
from rotemina.plugins.microscope.picture_view import PictureView

_STEPS = 100.0  # of the slider, from the least gamma to the greatest, by its logarithm


class PictureSection(Section):
    """Contrast by hand or by itself, and the histogram that it is read from."""

    def __init__(self, view: PictureView, theme: Theme) -> None:
        super().__init__(tr("Contrast"))
        self._view = view
        self.histogram = HistogramView(theme)
        self.histogram.moved.connect(self._set_levels)
        self.auto = QCheckBox(tr("automatic levels"))
        self.auto.setToolTip(plain_tip(tr("Black and white at 0.1 and 99.9 % of the pixels")))
        self.auto.setChecked(True)
        self.auto.toggled.connect(lambda on: self._change(auto=on))
        self.whole = button(tr("Whole range"), lambda: self._set_levels(0.0, 1.0))
        self.whole.setToolTip(plain_tip(tr("Black at 0, white at the largest number")))
        self.gamma = named(QSlider(Qt.Orientation.Horizontal), tr("Gamma"))
        self.gamma.setRange(0, int(_STEPS))
        self.gamma.setValue(int(_STEPS / 2))
        self.gamma.valueChanged.connect(lambda step: self._change(gamma=_gamma(step)))
        self._gamma_text = QLabel()
        self.table = SteadyChoice(tr("Colours"), letters=6)
        for table in Table:
            self.table.addItem(spoken(table), table)
        self.table.currentIndexChanged.connect(
            lambda _: self._change(table=self.table.currentData())
        )
        self.column.addWidget(self.histogram)
        self.column.addWidget(self.auto)
        self.column.addWidget(self.whole)
        self.add_row(self._gamma_text, self.gamma)
        self.column.addWidget(self.table)
        self._change()

    def refresh(self, status: MicroscopeStatus) -> None:
        """Show the newest picture's histogram."""
        if status.feed.frame is not None:
            self.histogram.show_counts(histogram(status.feed.frame), self._view.span)

    def set_theme(self, theme: Theme) -> None:
        """Change the colours."""
        self.histogram.theme = theme
        self.histogram.update()

    def _set_levels(self, low: float, high: float) -> None:
        self.auto.blockSignals(True)
        self.auto.setChecked(False)
        self.auto.blockSignals(False)
        self._change(auto=False, low=low, high=high)

    def _change(self, **changes: object) -> None:
        contrast: Contrast = replace(self._view.contrast, **changes)  # type: ignore[arg-type]
        if changes.get("auto") is False and "low" not in changes:
            low, high = self._view.span  # by hand from where it is
            contrast = replace(contrast, low=low, high=high)
        self._view.set_contrast(contrast)
        self._gamma_text.setText(tr("gamma {gamma:.2f}").format(gamma=contrast.gamma))
        tip = tr("{low:g} to {high:g}; 1: linear; smaller values brighten dark regions")
        self.gamma.setToolTip(plain_tip(tip.format(low=GAMMA[0], high=GAMMA[1])))


class LayerSection(Section):
    """What is shown over the picture."""

    def __init__(self, view: PictureView, settings: Settings) -> None:
        super().__init__(tr("Over the picture"))
        self.boxes: dict[Layer, QCheckBox] = {}
        for layer in Layer:
            box = QCheckBox(spoken(layer))
            box.setToolTip(
                plain_tip(tr("Show over the picture: {layer}").format(layer=spoken(layer)))
            )
            key = f"microscope.layer.{layer.name.lower()}"
            box.setChecked(bool(settings.get(key, layer in view.layers)))
            view.set_layer(layer, box.isChecked())
            box.toggled.connect(lambda on, layer=layer: view.set_layer(layer, on))
            box.toggled.connect(lambda on, key=key: settings.set(key, on))
            self.boxes[layer] = box
            self.column.addWidget(box)


def _gamma(step: int) -> float:
    low, high = GAMMA
    return float(low * (high / low) ** (step / _STEPS))
