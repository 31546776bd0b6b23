"""View of where the gap is: axes and taps, a heat map of the chosen tap, and traces of a cell."""

import math
from itertools import pairwise

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QSplitter, QStackedWidget, QWidget

from rotemina.app.language import get_axis_label
from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.widgets.layout import make_column
from rotemina.app.widgets.style import Theme
from rotemina.app.widgets.text import TextTable, make_plain_label
from rotemina.plugins.gap import mark, tr
from rotemina.plugins.gap.answer.diagnosis_answer import DiagnosisAnswer
from rotemina.plugins.gap.answer.heat_cell import find_contributions
from rotemina.plugins.gap.answer.heat_cell_view import HeatCellView
from rotemina.plugins.gap.answer.words import regime_name
from rotemina.sim.gap.location import LocatedGap
from rotemina.sim.gap.output import GapHeatmap, compute_shares
from rotemina.sim.messages import NO_VALUE, format_rounded
from rotemina.sim.units import (
    format_percent,
    format_percent_interval,
    format_quantity,
)

PLACE_HEADINGS = (
    mark("axis, signal"),
    mark("share"),
    mark("gap rms"),
    mark("floor"),
    mark("worst at"),
    mark("motion"),
    mark("95 % interval"),
)
_HEADING_TOOLTIPS = (
    mark("Signal: u is the voltage, ref the reference sensor, meas the machine's own sensor"),
    mark("Share of the gap above the noise floors of all axes and channels"),
    mark("Measured minus model, mean removed"),
    mark("Rms of noise and rounding of the sensor, which no model explains"),
    mark("Band with the largest share"),
    mark("Motion of the axis where the gap is largest"),
    mark("95 % interval of the share"),
)

# The columns of the bands begin here, after those of the motion and the share.
_FIRST_BAND_COLUMN = 2

# The shading of the cells begins at this gap, in noise floors, and spans this many decades.
_MIN_SHADED_FLOORS = 0.3
_SHADED_DECADES = 3.0

# Alpha (0 to 255) of the strongest shade. The numbers must stay readable.
_MAX_ALPHA = 170


class DistributionView(QSplitter):
    """View with the axes and taps on the left, and a heat map or a cell's traces on the right."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        self._theme = theme
        self._answer: DiagnosisAnswer | None = None
        self._places: list[LocatedGap] = []
        self.places = TextTable(tr("Where the gap lies"), [tr(text) for text in PLACE_HEADINGS])
        for column, text in enumerate(_HEADING_TOOLTIPS):
            self.places.horizontalHeaderItem(column).setToolTip(make_tooltip(tr(text)))
        self.heat_title = make_plain_label(quiet=False, wrap=True)
        self.heat = TextTable(tr("Gap by band and regime"), selectable=False)
        self.heat.setCursor(Qt.CursorShape.PointingHandCursor)
        self.heat.cellClicked.connect(self.open_cell)
        self.heat.cellActivated.connect(self.open_cell)
        self.cell = HeatCellView(theme)
        self.cell.closed.connect(lambda: self.right.setCurrentIndex(0))
        map_page = QWidget()
        column = make_column(
            self.heat_title, (self.heat, 1), on=map_page, margins=(4, 0, 0, 0), spacing=2
        )
        self.right = QStackedWidget()
        self.right.addWidget(map_page)
        self.right.addWidget(self.cell)
        self.addWidget(self.places)
        self.addWidget(self.right)
        self.setSizes([520, 420])
        self.places.currentCellChanged.connect(lambda *_: self._show_heat())

    def show_answer(self, answer: DiagnosisAnswer) -> None:
        """Show where the gap is, largest first. Places where it may be noise are greyed out."""
        self._answer = answer
        places = answer.diagnosis.places
        all_places = [
            place for diagnosis in answer.diagnosis.axes.values() for place in diagnosis.places
        ]
        self._places = [*places, *(place for place in all_places if not place.is_significant)]
        place_shares = {
            (place.axis, place.tap): share
            for place, share in zip(places, compute_shares(places), strict=True)
        }
        rows = [
            _make_row(place, answer, place_shares.get((place.axis, place.tap)))
            for place in self._places
        ]
        quiet = QColor(self._theme.quiet)
        self.places.show_rows(
            rows, [None if place.is_significant else quiet for place in self._places]
        )
        if self._places:
            self.places.selectRow(0)
        self._show_heat()

    def open_cell(self, row: int, column: int) -> None:
        """Show the traces of a cell of the heat map: the gap in one band during one regime."""
        place = self._selected_place
        band = column - _FIRST_BAND_COLUMN
        if self._answer is None or place is None or band < 0:
            return
        heat = self._answer.heat_maps[place.axis, place.tap]
        traces = [trace for trace in self._answer.traces[place.axis] if trace.tap is place.tap]
        low, high = heat.edges_hz[band], heat.edges_hz[band + 1]
        title = tr("{axis} {tap}, {regime}, {low:g} to {high:g} Hz").format(
            axis=get_axis_label(place.axis),
            tap=place.tap,
            regime=regime_name(heat.regimes[row]),
            low=low,
            high=high,
        )
        self.cell.show_contributions(
            title, self._answer.names, find_contributions(traces, heat, row, band)
        )
        self.right.setCurrentWidget(self.cell)

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self.cell.set_theme(theme)
        if self._answer is not None:
            self.show_answer(self._answer)

    @property
    def _selected_place(self) -> LocatedGap | None:
        row = self.places.currentRow()
        return self._places[row] if 0 <= row < len(self._places) else None

    def _show_heat(self) -> None:
        self.right.setCurrentIndex(0)
        place = self._selected_place
        if self._answer is None or place is None:
            self._show_message("")
            return
        name = f"{get_axis_label(place.axis)} {place.tap}"
        heat = self._answer.heat_maps.get((place.axis, place.tap))
        if heat is None:
            text = tr("{place}: no record is long enough and evenly sampled for a map")
            self._show_message(text.format(place=name))
            return
        self.heat_title.setText(
            tr(
                "{place}: gap rms [noise floors] by motion and frequency band; the headings are "
                "the lower ends of the bands in Hz. Click a cell to see its traces."
            ).format(place=name)
        )
        self._draw_heat(heat)

    def _show_message(self, text: str) -> None:
        self.heat_title.setText(text)
        self.heat.show_rows([])
        self.heat.set_headers(())

    def _draw_heat(self, heat: GapHeatmap) -> None:
        edges = [format_rounded(edge, 6) for edge in heat.edges_hz]
        self.heat.set_headers((tr("motion"), tr("share"), *edges[:-1]))
        band_tooltip = tr("{low} to {high} Hz")
        for column, (low, high) in enumerate(pairwise(edges), start=_FIRST_BAND_COLUMN):
            self.heat.horizontalHeaderItem(column).setToolTip(
                band_tooltip.format(low=low, high=high)
            )
        self.heat.show_rows(
            [
                (
                    regime_name(regime),
                    format_percent(float(share.sum())),
                    *map(_format_floors, floors),
                )
                for regime, floors, share in zip(heat.regimes, heat.floors, heat.share, strict=True)
            ]
        )
        cell_tooltip = tr("{regime}, {low} to {high} Hz: {floors} noise floors rms")
        share_tooltip = tr("{share} of the gap of the channel")
        for row, floors in enumerate(heat.floors):
            for column, value in enumerate(floors, start=_FIRST_BAND_COLUMN):
                colour = QColor(self._theme.real)
                colour.setAlpha(round(_MAX_ALPHA * compute_warmth(value)))
                item = self.heat.item(row, column)
                item.setBackground(colour)
                share = format_percent(float(heat.share[row][column - _FIRST_BAND_COLUMN]))
                low, high = (
                    edges[column - _FIRST_BAND_COLUMN],
                    edges[column - _FIRST_BAND_COLUMN + 1],
                )
                item.setToolTip(
                    make_tooltip(
                        cell_tooltip.format(
                            regime=regime_name(heat.regimes[row]),
                            low=low,
                            high=high,
                            floors=_format_floors(value),
                        ),
                        share_tooltip.format(share=share),
                        tr("Click to see the traces"),
                    )
                )


def compute_warmth(floors: float) -> float:
    """Return the intensity of a cell's colour, 0 to 1, for a gap in noise floors."""
    return min(max(math.log10(max(floors, 1e-9) / _MIN_SHADED_FLOORS) / _SHADED_DECADES, 0.0), 1.0)


def _format_floors(value: float) -> str:
    return "< 0.01" if 0.0 < value < 0.01 else format_rounded(value, 2)


def _make_row(
    place: LocatedGap, answer: DiagnosisAnswer, share: tuple[float, tuple[float, float]] | None
) -> tuple[str, ...]:
    unit = answer.unit(place.axis, place.tap)
    band = place.worst_band_hz
    return (
        f"{get_axis_label(place.axis)} {place.tap}",
        format_percent(share[0]) if share is not None else tr("noise"),
        format_quantity(place.gap_rms, unit),
        format_quantity(place.noise_floor, unit),
        NO_VALUE
        if band is None
        else f"{format_rounded(band[0], 3)}…{format_rounded(band[1], 3)} Hz",
        NO_VALUE if place.worst_regime is None else regime_name(place.worst_regime),
        format_percent_interval(share[1]) if share is not None else NO_VALUE,
    )
