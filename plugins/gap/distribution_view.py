"""Where the gap lies: axes and taps, the heat map of the chosen one, and what is behind a cell."""

import math
from itertools import pairwise

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QSplitter, QStackedWidget, QWidget

from rotemina.app.display_units import label
from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.controls import plain_tip
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_column
from rotemina.app.widgets.table import Table
from rotemina.plugins.gap import mark, tr
from rotemina.plugins.gap.diagnosis_answer import Answer
from rotemina.plugins.gap.heat_cell import parts
from rotemina.plugins.gap.heat_cell_view import HeatCellView
from rotemina.plugins.gap.words import regime_name
from rotemina.sim.gap.location.located_gap import LocatedGap
from rotemina.sim.gap.output.document import shares
from rotemina.sim.gap.output.report.heat import Heat
from rotemina.sim.quantities import NOTHING, amount, percent, percents, rounded

HEAD = (
    mark("axis, signal"),
    mark("share"),
    mark("gap rms"),
    mark("floor"),
    mark("worst at"),
    mark("motion"),
    mark("95 % interval"),
)
_TIPS = (
    mark("Signal: u is the voltage, ref the reference sensor, meas the machine's own sensor"),
    mark("Share of the gap above the noise floors of all axes and channels"),
    mark("Measured minus model, mean removed"),
    mark("Rms of noise and rounding of the sensor, which no model explains"),
    mark("Band with the largest share"),
    mark("Motion of the axis where the gap is largest"),
    mark("95 % interval of the share"),
)
_BANDS = 2  # columns before those of the bands
_COLDEST = 0.3  # floors
_DECADES = 3.0  # from the coldest to the warmest
_STRENGTH = 170  # of the warmest colour, of 255


class DistributionView(QSplitter):
    """Places of the gap on the left; on the right band by regime, or what is behind a cell."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        self._theme = theme
        self._answer: Answer | None = None
        self._places: list[LocatedGap] = []
        self.places = Table(tr("Where the gap lies"), [tr(text) for text in HEAD])
        for column, text in enumerate(_TIPS):
            self.places.horizontalHeaderItem(column).setToolTip(plain_tip(tr(text)))
        self.heat_title = plain_text(quiet=False, wrap=True)
        self.heat = Table(tr("Gap by band and regime"), choose=False)
        self.heat.setCursor(Qt.CursorShape.PointingHandCursor)
        self.heat.cellClicked.connect(self.open_cell)
        self.heat.cellActivated.connect(self.open_cell)
        self.cell = HeatCellView(theme)
        self.cell.closed.connect(lambda: self.right.setCurrentIndex(0))
        whole = QWidget()
        column = in_column(
            self.heat_title, (self.heat, 1), on=whole, margins=(4, 0, 0, 0), spacing=2
        )
        self.right = QStackedWidget()
        self.right.addWidget(whole)
        self.right.addWidget(self.cell)
        self.addWidget(self.places)
        self.addWidget(self.right)
        self.setSizes([520, 420])
        self.places.currentCellChanged.connect(lambda *_: self._show_heat())

    def show_answer(self, answer: Answer) -> None:
        """Show where the gap lies, the largest first; what may be noise stands back."""
        self._answer = answer
        found = answer.diagnosis.places
        every = [place for one in answer.diagnosis.axes.values() for place in one.places]
        self._places = [*found, *(place for place in every if not place.significant)]
        known = {
            (place.axis, place.tap): share
            for place, share in zip(found, shares(found), strict=True)
        }
        rows = [_row(place, answer, known.get((place.axis, place.tap))) for place in self._places]
        quiet = QColor(self._theme.quiet)
        self.places.show_rows(
            rows, [None if place.significant else quiet for place in self._places]
        )
        if self._places:
            self.places.selectRow(0)
        self._show_heat()

    def open_cell(self, row: int, column: int) -> None:
        """Show the traces of a place of the heat map: what lies in this band, in this regime."""
        place = self._place
        band = column - _BANDS
        if self._answer is None or place is None or band < 0:
            return
        heat = self._answer.heats[place.axis, place.tap]
        own = [one for one in self._answer.traces[place.axis] if one.tap is place.tap]
        low, high = heat.edges_hz[band], heat.edges_hz[band + 1]
        title = tr("{axis} {tap}, {regime}, {low:g} to {high:g} Hz").format(
            axis=label(place.axis),
            tap=place.tap,
            regime=regime_name(heat.regimes[row]),
            low=low,
            high=high,
        )
        self.cell.show_parts(title, self._answer.names, parts(own, heat, row, band))
        self.right.setCurrentWidget(self.cell)

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self.cell.set_theme(theme)
        if self._answer is not None:
            self.show_answer(self._answer)

    @property
    def _place(self) -> LocatedGap | None:
        row = self.places.currentRow()
        return self._places[row] if 0 <= row < len(self._places) else None

    def _show_heat(self) -> None:
        self.right.setCurrentIndex(0)
        place = self._place
        if self._answer is None or place is None:
            self._clear("")
            return
        name = f"{label(place.axis)} {place.tap}"
        heat = self._answer.heats.get((place.axis, place.tap))
        if heat is None:
            text = tr("{place}: no record is long enough and evenly sampled for a map")
            self._clear(text.format(place=name))
            return
        self.heat_title.setText(
            tr(
                "{place}: gap rms [noise floors] by motion and frequency, from … Hz on. "
                "Click a cell to see its traces."
            ).format(place=name)
        )
        self._draw(heat)

    def _clear(self, text: str) -> None:
        self.heat_title.setText(text)
        self.heat.show_rows([])
        self.heat.set_head(())

    def _draw(self, heat: Heat) -> None:
        edges = [rounded(edge, 6) for edge in heat.edges_hz]
        self.heat.set_head((tr("motion"), tr("share"), *edges[:-1]))
        between = tr("{low} to {high} Hz")
        for column, (low, high) in enumerate(pairwise(edges), start=_BANDS):
            self.heat.horizontalHeaderItem(column).setToolTip(between.format(low=low, high=high))
        self.heat.show_rows(
            [
                (regime_name(regime), percent(float(share.sum())), *map(_few, floors))
                for regime, floors, share in zip(heat.regimes, heat.floors, heat.share, strict=True)
            ]
        )
        here = tr("{regime}, {low} to {high} Hz: {floors} noise floors rms")
        whole = tr("{share} of the gap of the channel")
        for row, floors in enumerate(heat.floors):
            for column, value in enumerate(floors, start=_BANDS):
                colour = QColor(self._theme.real)
                colour.setAlpha(round(_STRENGTH * warmth(value)))
                item = self.heat.item(row, column)
                item.setBackground(colour)
                share = percent(float(heat.share[row][column - _BANDS]))
                low, high = edges[column - _BANDS], edges[column - _BANDS + 1]
                item.setToolTip(
                    plain_tip(
                        here.format(
                            regime=regime_name(heat.regimes[row]),
                            low=low,
                            high=high,
                            floors=_few(value),
                        ),
                        whole.format(share=share),
                        tr("Click to see the traces"),
                    )
                )


def warmth(floors: float) -> float:
    """Return how warm a cell looks, 0 to 1."""
    return min(max(math.log10(max(floors, 1e-9) / _COLDEST) / _DECADES, 0.0), 1.0)


def _few(value: float) -> str:
    return "< 0.01" if 0.0 < value < 0.01 else rounded(value, 2)


def _row(
    place: LocatedGap, answer: Answer, share: tuple[float, tuple[float, float]] | None
) -> tuple[str, ...]:
    unit = answer.unit(place.axis, place.tap)
    band = place.worst_band_hz
    return (
        f"{label(place.axis)} {place.tap}",
        percent(share[0]) if share is not None else tr("noise"),
        amount(place.gap_rms, unit),
        amount(place.noise_floor, unit),
        NOTHING if band is None else f"{rounded(band[0], 3)}…{rounded(band[1], 3)} Hz",
        NOTHING if place.worst_regime is None else regime_name(place.worst_regime),
        percents(share[1]) if share is not None else NOTHING,
    )
