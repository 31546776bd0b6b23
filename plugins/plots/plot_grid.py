"""The layout of the plots: stages side by side, or all axes in one strip."""

from collections.abc import Mapping, Sequence

from PySide6.QtWidgets import QWidget

from rotemina.app.widgets.layouts import in_grid
from rotemina.plugins.plots.axis_plot import AxisPlot


class PlotGrid(QWidget):
    """Arranges the plots of a robot's axes.

    ``stacks`` are the axes of each stage, from above downwards.
    """

    def __init__(self, plots: Mapping[str, AxisPlot], stacks: Sequence[Sequence[str]]) -> None:
        super().__init__()
        self._plots, self._stacks = plots, stacks
        self._grid = in_grid(on=self, margins=0, spacing=6)
        self._in_strip = True
        self.arrange(strip=False)

    @property
    def least_height(self) -> int:
        """The height below which stacked plots would be cut, px."""
        return sum(
            self._plots[name].minimumSizeHint().height() for name in max(self._stacks, key=len)
        )

    def arrange(self, *, strip: bool) -> None:
        """Put all plots into one row, or those of each stage into a column."""
        if strip is self._in_strip:
            return
        self._in_strip = strip
        number = 0
        for place, axes in enumerate(self._stacks):
            for row, name in enumerate(axes):
                self._grid.addWidget(self._plots[name], *((0, number) if strip else (row, place)))
                self._plots[name].stand_in_strip(strip=strip)
                number += 1
        for column in range(number):  # those of the other arrangement take no room
            used = strip or column < len(self._stacks)
            self._grid.setColumnStretch(column, 1 if used else 0)

    def share_height(self) -> None:
        """Give all traces the same height: the lowest ones have the times below them as well."""
        rows = 1 if self._in_strip else max(map(len, self._stacks))
        lowest = self._plots[max(self._stacks, key=len)[-1]].plot.getPlotItem()
        times = 0 if self._in_strip else round(lowest.getAxis("bottom").height())
        trace = max((self.height() - times) // rows, 1)
        for row in range(max(map(len, self._stacks))):
            stretch = trace + (times if row == rows - 1 else 0)
            self._grid.setRowStretch(row, stretch if row < rows else 0)
        title = self._plots[self._stacks[0][0]].figures.height()
        for plot in self._plots.values():
            plot.share_height(trace - title)
