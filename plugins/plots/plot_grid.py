"""The layout of the plots: each stage a column, each a row, or all axes in one strip."""

from collections.abc import Mapping, Sequence
from itertools import zip_longest

from PySide6.QtWidgets import QWidget

from rotemina.app.shell.plot import AXIS_WIDTH, RIGHT_MARGIN
from rotemina.app.widgets.layouts import in_grid
from rotemina.plugins.plots.axis_plot import AxisPlot

_SPACING = 6
_LEAST_WIDTH = AXIS_WIDTH + RIGHT_MARGIN + 100  # of a plot in which a course can be seen, px
_Rows = Sequence[Sequence[str | None]]


class PlotGrid(QWidget):
    """Arranges the plots of a robot's axes.

    ``stages`` are the axes of each stage.
    """

    def __init__(self, plots: Mapping[str, AxisPlot], stages: Sequence[Sequence[str]]) -> None:
        super().__init__()
        self._plots = plots
        stages = [axes for axes in stages if axes]
        self._strip: _Rows = [[name for axes in stages for name in axes]]
        self._columns: _Rows = list(zip_longest(*stages))
        self._stages: _Rows = stages
        self._grid = in_grid(on=self, margins=0, spacing=_SPACING)
        self._rows: _Rows = []
        self._arrange(self._columns)

    def arrange(self, width: int, height: int, head: int) -> bool:
        """Put the plots into the rows that fit, px; return whether a head of that height fits too.

        Where the height is short, the head is left out first. All plots share one row only where
        each is wide enough to be read, or where nothing else fits.
        """
        columns, stages = self._columns, self._stages
        ways = [(columns, height - head), (stages, height - head)]
        if width < _LEAST_WIDTH * len(self._plots):
            ways.append((stages, height))
        fitting = (way for way in ways if self._least_height(way[0]) <= way[1])
        rows, room = next(fitting, (self._strip, height))
        if rows is not self._rows:
            self._arrange(rows)
        return room < height

    def _least_height(self, rows: _Rows) -> int:
        """Return the height below which plots would be cut, px."""
        lowest = _lowest(rows)
        heights = [
            max(self._plots[name].least_height(times=name in lowest) for name in row if name)
            for row in rows
        ]
        return sum(heights) + _SPACING * (len(rows) - 1)

    def _arrange(self, rows: _Rows) -> None:
        self._rows = rows
        lowest = _lowest(rows) if rows is not self._strip else set()
        for number, row in enumerate(rows):
            for column, name in enumerate(row):
                if name is not None:
                    self._grid.addWidget(self._plots[name], number, column)
                    self._plots[name].stand(times=name in lowest, strip=rows is self._strip)
        for column in range(self._grid.columnCount()):  # those of others take no room
            self._grid.setColumnStretch(column, 1 if column < max(map(len, rows)) else 0)

    def share_height(self) -> None:
        """Give all traces the same height: the lowest ones have the times below them as well."""
        count = len(self._rows)
        lowest = self._plots[next(name for name in self._rows[-1] if name)].plot.getPlotItem()
        times = 0 if self._rows is self._strip else round(lowest.getAxis("bottom").maximumHeight())
        trace = max((self.height() - times) // count, 1)
        for row in range(self._grid.rowCount()):
            stretch = trace + (times if row == count - 1 else 0)
            self._grid.setRowStretch(row, stretch if row < count else 0)
        for plot in self._plots.values():
            plot.share_height(trace - plot.figures.height())


def _lowest(rows: _Rows) -> set[str]:
    """Return the names below which there is no other."""
    return {[name for name in column if name][-1] for column in zip_longest(*rows)}
