"""Layout of the plots: a column for each stage, a row for each stage, or all in a single row."""

from collections.abc import Mapping, Sequence
from itertools import zip_longest

from PySide6.QtWidgets import QWidget

from rotemina.app.widgets.drawing import AXIS_WIDTH_PX, RIGHT_MARGIN_PX
from rotemina.app.widgets.layout import make_grid
from rotemina.plugins.plots.axis_plot import AxisPlot

_SPACING_PX = 6
# Narrower plots are not readable.
_MIN_PLOT_WIDTH_PX = AXIS_WIDTH_PX + RIGHT_MARGIN_PX + 100
_Rows = Sequence[Sequence[str | None]]


class PlotGrid(QWidget):
    """Grid of the plots of all axes.

    Parameters
    ----------
    plots : mapping from axis to AxisPlot
    stages : sequence of sequence of str
        The axes of each stage.
    """

    def __init__(self, plots: Mapping[str, AxisPlot], stages: Sequence[Sequence[str]]) -> None:
        super().__init__()
        self._plots = plots
        stages = [axes for axes in stages if axes]
        self._single_row: _Rows = [[name for axes in stages for name in axes]]
        self._stages_as_columns: _Rows = list(zip_longest(*stages))
        self._stages_as_rows: _Rows = stages
        self._grid = make_grid(on=self, margins=0, spacing=_SPACING_PX)
        self._rows: _Rows = []
        self._place_plots(self._stages_as_columns)

    def arrange(self, width: int, height: int, head_height: int) -> bool:
        """Arrange the plots in the rows that fit, and return whether the head fits too.

        If the height is too small, the head is left out first. All plots share a single row only
        if each is wide enough to be readable, or if nothing else fits.

        Parameters
        ----------
        width, height : int
            The available size, px.
        head_height : int
            The height of the controls above the plots, px.
        """
        columns, stages = self._stages_as_columns, self._stages_as_rows
        layouts = [(columns, height - head_height), (stages, height - head_height)]
        if width < _MIN_PLOT_WIDTH_PX * len(self._plots):
            layouts.append((stages, height))
        fitting = (layout for layout in layouts if self._compute_min_height(layout[0]) <= layout[1])
        rows, available_height = next(fitting, (self._single_row, height))
        if rows is not self._rows:
            self._place_plots(rows)
        return available_height < height

    def _compute_min_height(self, rows: _Rows) -> int:
        lowest_plots = _find_lowest_plots(rows)
        heights = [
            max(
                self._plots[name].compute_min_height(times=name in lowest_plots)
                for name in row
                if name
            )
            for row in rows
        ]
        return sum(heights) + _SPACING_PX * (len(rows) - 1)

    def _place_plots(self, rows: _Rows) -> None:
        self._rows = rows
        lowest_plots = _find_lowest_plots(rows) if rows is not self._single_row else set()
        for row, names in enumerate(rows):
            for column, name in enumerate(names):
                if name is not None:
                    self._grid.addWidget(self._plots[name], row, column)
                    self._plots[name].set_time_axis(
                        times=name in lowest_plots, single_row=rows is self._single_row
                    )
        # Columns that only other arrangements use must not take up space.
        for column in range(self._grid.columnCount()):
            self._grid.setColumnStretch(column, 1 if column < max(map(len, rows)) else 0)

    def equalise_heights(self) -> None:
        """Give all traces the same height, although the lowest plots also have a time axis."""
        count = len(self._rows)
        lowest_item = self._plots[next(name for name in self._rows[-1] if name)].plot.getPlotItem()
        time_axis_height = (
            0
            if self._rows is self._single_row
            else round(lowest_item.getAxis("bottom").maximumHeight())
        )
        trace_height = max((self.height() - time_axis_height) // count, 1)
        for row in range(self._grid.rowCount()):
            stretch = trace_height + (time_axis_height if row == count - 1 else 0)
            self._grid.setRowStretch(row, stretch if row < count else 0)
        for plot in self._plots.values():
            plot.split_height(trace_height - plot.figures.height())


def _find_lowest_plots(rows: _Rows) -> set[str]:
    return {[name for name in column if name][-1] for column in zip_longest(*rows)}
