"""Plots one picture with linear or logarithmic axes, in the colours of the theme."""

import math
from collections.abc import Sequence
from html import escape

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QSizePolicy, QWidget

from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.widgets.drawing import LineStyle, SignalPlot
from rotemina.app.widgets.layout import make_column
from rotemina.app.widgets.style import Theme
from rotemina.app.widgets.text import make_colour_legend
from rotemina.plugins.identification.findings import AnalysisPicture, translate_text
from rotemina.sim.arrays import FloatArray

# The left axis has the same width in all charts, so that adjacent charts line up.
_AXIS_WIDTH_PX = 50

# If an axis covers at most this many decades, the numbers 2 and 5 of each decade are shown too.
_MAX_DECADES_WITH_2_AND_5 = 1.6

_MIN_NUMBER_SPACING_PX = 34

# The margin around the curves, as a fraction of their range.
_MARGIN_RATIO = 0.04

# An axis covers at least this many decades. With fewer, there might be no number on it at all.
_MIN_DECADES = 1.0


class PicturePlot(SignalPlot):
    """Plot of the curves of one picture. The next picture replaces them."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme)
        self.getPlotItem().getAxis("left").setWidth(_AXIS_WIDTH_PX)
        self.setMinimumSize(110, 120)
        for side in ("left", "bottom"):
            # By default, pyqtgraph numbers all nine ticks of a decade, and the numbers overlap.
            self.getPlotItem().getAxis(side).logTickValues = compute_log_ticks

    def draw(self, picture: AnalysisPicture) -> None:
        """Replace the picture."""
        lines = {
            str(index): LineStyle(curve.role, curve.width)
            for index, curve in enumerate(picture.curves)
        }
        restyled_names = [
            name for name, line in self._line_styles.items() if lines.get(name) != line
        ]
        for name in restyled_names:
            self.removeItem(self._curves.pop(name))
            del self._line_styles[name]
        item = self.getPlotItem()
        for side, is_logarithmic in (("left", picture.log_y), ("bottom", picture.log_x)):
            axis = item.getAxis(side)
            axis.setLogMode(is_logarithmic)
            # Grid lines within a decade have no number.
            axis.setStyle(maxTextLevel=0 if is_logarithmic else 2)
        item.setLabel("bottom", translate_text(picture.bottom))
        for index, curve in enumerate(picture.curves):
            name = str(index)
            if name not in self._curves:
                self.add_curve(name, lines[name])
            x, y = _to_axis_scale(curve.x, picture.log_x), _to_axis_scale(curve.y, picture.log_y)
            if picture.in_time:
                self.show_signal(name, x, y)
            else:
                # `show_signal` would reduce the curve to its extremes in each interval of x. A loop
                # would then no longer be a closed curve.
                self._curves[name].setData(x, y)
        self._fit(picture)

    def read_points(self, index: int) -> tuple[FloatArray, FloatArray]:
        """Return x and y (n,) of a curve as drawn: on a logarithmic axis, the logarithms."""
        x, y = self._curves[str(index)].getData()
        return np.asarray(x), np.asarray(y)

    def _fit(self, picture: AnalysisPicture) -> None:
        points = [self.read_points(index) for index in range(len(picture.curves))]
        x_range = _find_range([x for x, _ in points])
        data_range = _find_range([y for _, y in points])
        low, high = picture.y_range if picture.y_range is not None else data_range
        if picture.log_y and high - low < _MIN_DECADES:
            middle = (low + high) / 2.0
            low, high = middle - _MIN_DECADES / 2, middle + _MIN_DECADES / 2
        self.setRange(xRange=x_range, yRange=(low, high), padding=0.0)


def compute_log_ticks(
    low: float, high: float, size: float, ticks: list[tuple[float, list[float]]]
) -> list[tuple[float | None, list[float]]]:
    """Return the ticks of a logarithmic axis from 10^low to 10^high, in the format of pyqtgraph.

    The ticks of the first group have numbers. They are 1, 2 and 5 of each decade, or only whole
    decades if there are many. The second group contains all ticks within a decade, which have grid
    lines but no numbers. ``size`` is the length of the axis in pixels.
    """
    decades = range(math.floor(low), math.ceil(high) + 1)
    decade_step = max(round(_MIN_NUMBER_SPACING_PX * (high - low) / max(size, 1.0)), 1)
    has_many_decades = high - low > _MAX_DECADES_WITH_2_AND_5
    numbered_multiples = (1,) if has_many_decades else (1, 2, 5)
    numbered_ticks = [
        decade + math.log10(multiple)
        for decade in decades
        if decade % decade_step == 0
        for multiple in numbered_multiples
    ]
    other_ticks = (
        [decade + math.log10(multiple) for decade in decades for multiple in range(2, 10)]
        if decade_step == 1
        else []
    )
    return [
        (1.0, [tick for tick in numbered_ticks if low <= tick <= high]),
        (None, [tick for tick in other_ticks if low < tick < high]),
    ]


class PictureChart(QWidget):
    """Chart with a title, the names of the curves in their colours, and the plot below them."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._picture: AnalysisPicture | None = None
        self.title = QLabel()
        self.title.setTextFormat(Qt.TextFormat.RichText)
        # A long title must not widen the chart. It is cut off instead.
        self.title.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.plot = PicturePlot(theme)
        make_column(self.title, (self.plot, 1), on=self, margins=(4, 0, 0, 0), spacing=2)

    def show_picture(self, picture: AnalysisPicture) -> None:
        """Replace the picture."""
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
        title = escape(translate_text(self._picture.title))
        names_and_roles = [
            (translate_text(curve.name), curve.role) for curve in self._picture.curves if curve.name
        ]
        self.title.setText(
            f"{title}: {make_colour_legend(self._theme, names_and_roles)}"
            if len(names_and_roles) > 1
            else title
        )
        # The title may be cut off, so the tooltip shows its full text.
        names = ", ".join(name for name, _ in names_and_roles)
        full_title = translate_text(self._picture.title)
        self.title.setToolTip(make_tooltip(f"{full_title}: {names}" if names else full_title))


def _find_range(curves: Sequence[FloatArray]) -> tuple[float, float]:
    """Return the range of all finite values, extended by a margin."""
    values = np.concatenate([[], *curves])
    values = values[np.isfinite(values)]
    if values.size == 0:
        return 0.0, 1.0
    low, high = float(values.min()), float(values.max())
    margin = _MARGIN_RATIO * (high - low) or 0.5 * abs(low) or 0.5
    return low - margin, high + margin


def _to_axis_scale(values: FloatArray, is_logarithmic: bool) -> FloatArray:
    """Return values, or their logarithms on a logarithmic axis.

    Values that are not positive are first replaced by the smallest positive value.
    """
    if not is_logarithmic:
        return values
    positive_values = values[values > 0.0]
    return np.log10(np.maximum(values, positive_values.min() if len(positive_values) else 1.0))
