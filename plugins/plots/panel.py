"""Live time plots of every axis: command, model and measurement, or the gap between them."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QComboBox,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QVBoxLayout,
)

from rotemina.app.display import stages
from rotemina.app.panel import Area, Panel
from rotemina.app.shell.theme import Theme
from rotemina.app.shell.workbench import Workbench
from rotemina.plugins.plots.axis_plot import AxisPlot, Shown

SPANS_S = (2, 5, 10, 30, 60)
LEGEND = (("command", "command"), ("model", "model"), ("measured", "real"))


class PlotsPanel(Panel):
    """One plot an axis; the stages stand side by side."""

    title = "Plots"
    area = Area.CENTRE
    order = 10

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        lowest = {axes[-1] for axes in stages(workbench.robot).values() if axes}
        self.plots = {
            name: AxisPlot(workbench, column, times=name in lowest)
            for column, name in enumerate(workbench.robot.axes)
        }
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addLayout(self._header())
        grid = QGridLayout()
        grid.setSpacing(6)
        for place, axes in enumerate(stages(workbench.robot).values()):
            for row, name in enumerate(axes):
                grid.addWidget(self.plots[name], row, place)
        column.addLayout(grid, 1)
        workbench.shown.connect(lambda _: self.refresh())
        workbench.replaying.changed.connect(self._begin_anew)
        workbench.theme_changed.connect(self._use_theme)

    def refresh(self) -> None:
        """Draw the newest samples, unless paused or out of sight; recording goes on."""
        if self.pause.isChecked() or not self.isVisible():
            return
        span_s = float(self.span.currentData())
        window = self.workbench.source.history.tail(span_s)
        shown = Shown(self.shown.currentData())
        for plot in self.plots.values():
            plot.draw(window, span_s, shown)

    def _begin_anew(self) -> None:
        """Draw what is shown now: no picture of the machine stays in a replay, nor the reverse."""
        self.pause.setChecked(False)
        self.refresh()

    def _header(self) -> QHBoxLayout:
        self.shown = QComboBox()
        self.shown.addItem("Position", str(Shown.POSITION))
        self.shown.addItem("Gap: measured − model", str(Shown.GAP))
        self.shown.setAccessibleName("What the plots show")
        self.span = QComboBox()
        for seconds in SPANS_S:
            self.span.addItem(f"{seconds} s", seconds)
        self.span.setCurrentIndex(SPANS_S.index(10))
        self.span.setAccessibleName("How far back the plots show")
        self.pause = QPushButton("Pause")
        self.pause.setCheckable(True)
        self.pause.setToolTip("Hold the picture still; motion, recording and replay go on")
        self._legend = QLabel()
        self._legend.setTextFormat(Qt.TextFormat.RichText)
        self._use_theme(self.workbench.theme)
        row = QHBoxLayout()
        row.addWidget(self._legend, 1)
        row.addWidget(self.shown)
        row.addWidget(self.span)
        row.addWidget(self.pause)
        return row

    def _use_theme(self, theme: Theme) -> None:
        self._legend.setText(
            "&nbsp;&nbsp;".join(
                f'<span style="color:{getattr(theme, role)}">▬</span> {name}'
                for name, role in LEGEND
            )
        )
        for plot in self.plots.values():
            plot.use_theme(theme)
