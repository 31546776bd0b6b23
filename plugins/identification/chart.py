"""A plot of one picture, with linear or logarithmic axes, in the window's colours."""

import math
from collections.abc import Sequence
from html import escape

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QSizePolicy, QWidget

from rotemina.app.shell.plot import Line, SignalPlot
from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.controls import plain_tip
from rotemina.app.widgets.labels import legend
from rotemina.app.widgets.layouts import in_column
from rotemina.plugins.identification.filled_template import localized
from rotemina.plugins.identification.findings import Picture
from rotemina.sim.arrays import FloatArray

_AXIS_WIDTH = 50  # three charts stand side by side
_FEW_DECADES = 1.6
_PIXELS_A_NUMBER = 34
_MARGIN = 0.04
_LEAST_DECADES = 1.0  # of a logarithmic scale: a narrower one may hold no number to read


class PicturePlot(SignalPlot):
    """A plot whose curves come and go with the picture."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme)
        self.getPlotItem().getAxis("left").setWidth(_AXIS_WIDTH)
        self.setMinimumSize(110, 120)
        for side in ("left", "bottom"):
            # Of a logarithmic axis, pyqtgraph numbers all nine parts of a decade: they collide.
            self.getPlotItem().getAxis(side).logTickValues = log_ticks

    def draw(self, picture: Picture) -> None:
        """Draw a picture in place of the last."""
        lines = {
            str(number): Line(one.role, one.width) for number, one in enumerate(picture.curves)
        }
        for name in [name for name, line in self._pens.items() if lines.get(name) != line]:
            self.removeItem(self._curves.pop(name))
            del self._pens[name]
        item = self.getPlotItem()
        for side, logarithmic in (("left", picture.log_y), ("bottom", picture.log_x)):
            axis = item.getAxis(side)
            axis.setLogMode(logarithmic)
            # Lines within a decade carry no number.
            axis.setStyle(maxTextLevel=0 if logarithmic else 2)
        item.setLabel("bottom", localized(picture.bottom))
        for number, curve in enumerate(picture.curves):
            name = str(number)
            if name not in self._curves:
                self.add_curve(name, lines[name])
            x, y = _scaled(curve.x, picture.log_x), _scaled(curve.y, picture.log_y)
            if picture.in_time:
                self.show_signal(name, x, y)
            else:  # a loop comes back: thinning by its highest and lowest would tear it
                self._curves[name].setData(x, y)
        self._fit(picture)

    def values(self, number: int) -> tuple[FloatArray, FloatArray]:
        """Return the points (n,) of a curve as drawn: logarithms where the axis is so."""
        x, y = self._curves[str(number)].getData()
        return np.asarray(x), np.asarray(y)

    def _fit(self, picture: Picture) -> None:
        drawn = [self.values(number) for number in range(len(picture.curves))]
        across, up = (_with_margin([pair[side] for pair in drawn]) for side in (0, 1))
        low, high = picture.span if picture.span is not None else up
        if picture.log_y and high - low < _LEAST_DECADES:
            middle = (low + high) / 2.0
            low, high = middle - _LEAST_DECADES / 2, middle + _LEAST_DECADES / 2
        self.setRange(xRange=across, yRange=(low, high), padding=0.0)


def log_ticks(
    low: float, high: float, size: float, ticks: list[tuple[float, list[float]]]
) -> list[tuple[float | None, list[float]]]:
    """Return ticks of a logarithmic axis from 10^low to 10^high, as pyqtgraph asks for them.

    Those with numbers come first: 1, 2 and 5 of each decade, or whole decades where there are
    many; then the parts of a decade, as lines alone.
    """
    decades = range(math.floor(low), math.ceil(high) + 1)
    step = max(round(_PIXELS_A_NUMBER * (high - low) / max(size, 1.0)), 1)
    wide = high - low > _FEW_DECADES
    steps = (1,) if wide else (1, 2, 5)
    numbers = [d + math.log10(part) for d in decades if d % step == 0 for part in steps]
    lines = [d + math.log10(part) for d in decades for part in range(2, 10)] if step == 1 else []
    inside = [each for each in numbers if low <= each <= high]
    return [(1.0, inside), (None, [each for each in lines if low < each < high])]


class Chart(QWidget):
    """A title with the curves' names in their colours, and the plot below."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._picture: Picture | None = None
        self.title = QLabel()
        self.title.setTextFormat(Qt.TextFormat.RichText)
        # A long title is cut; it must not make the chart wider than its share.
        self.title.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.plot = PicturePlot(theme)
        in_column(self.title, (self.plot, 1), on=self, margins=(4, 0, 0, 0), spacing=2)

    def show_picture(self, picture: Picture) -> None:
        """Draw a picture in place of the last."""
        self._picture = picture
        self.plot.draw(picture)
        self._write_title()

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self.plot.set_theme(theme)
        self._write_title()

    def _write_title(self) -> None:
        if self._picture is None:
            return
        title = escape(localized(self._picture.title))
        named = [
            (localized(curve.name), curve.role) for curve in self._picture.curves if curve.name
        ]
        self.title.setText(f"{title}: {legend(self._theme, named)}" if len(named) > 1 else title)
        names = ", ".join(name for name, _ in named)  # in full, where the title is cut
        told = localized(self._picture.title)
        self.title.setToolTip(plain_tip(f"{told}: {names}" if names else told))


def _with_margin(drawn: Sequence[FloatArray]) -> tuple[float, float]:
    """Return what holds all finite values, and a little more."""
    values = np.concatenate([[], *drawn])
    values = values[np.isfinite(values)]
    if values.size == 0:
        return 0.0, 1.0
    low, high = float(values.min()), float(values.max())
    margin = _MARGIN * (high - low) or 0.5 * abs(low) or 0.5
    return low - margin, high + margin


def _scaled(values: FloatArray, logarithmic: bool) -> FloatArray:
    """Return values, or their logarithms; what is not above zero stands at the least that is."""
    if not logarithmic:
        return values
    above = values[values > 0.0]
    return np.log10(np.maximum(values, above.min() if len(above) else 1.0))
