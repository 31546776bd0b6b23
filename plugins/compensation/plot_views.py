"""Plots of the panel: loops, the front of a search, and responses of a loop."""

from html import escape

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QLabel, QWidget

from rotemina.app.shell.plot import Line, SignalPlot
from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.labels import legend, plain_text
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.app.widgets.table import Table
from rotemina.plugins.compensation import mark, tr
from rotemina.plugins.compensation.inverse_training import Learned
from rotemina.plugins.compensation.trial_motion import Aid, Trial
from rotemina.plugins.compensation.words import HEAD, NOTHING, judged, reasons
from rotemina.sim.arrays import FloatArray
from rotemina.sim.tuning.objectives import SecondObjective
from rotemina.sim.tuning.search import Generation, objectives_of
from rotemina.sim.tuning.search_problem import Evaluation
from rotemina.sim.tuning.tuning_result import Tuning

# Names of curves.
_POSITION, _WANTED = mark("position"), mark("desired")
_INVERTED, _FRONT = mark("its inverse"), mark("front")
_MICRO = 1e6
_AXIS_WIDTH = 52
_NEAR_PX = 40.0  # of a click to the point that it means


class _Plot(SignalPlot):
    """A plot of loops."""

    def draw(self, name: str, x: FloatArray, y: FloatArray) -> None:
        """Draw a curve (n,) as it is: thinning by its highest and lowest would tear a loop."""
        self._draw(name, x, y)
        self.autoRange(padding=0.04)


class Curves(QWidget):
    """A title with the names of curves in their colours, above a plot of them.

    Titles and names are marked texts, translated here; a title may hold ``{unit}``.
    """

    def __init__(self, theme: Theme, title: str, roles: dict[str, str], bottom: str) -> None:
        super().__init__()
        self._title, self._roles, self._bottom = title, roles, bottom
        self._theme, self._unit = theme, ""
        self.title = QLabel()
        self.title.setTextFormat(Qt.TextFormat.RichText)
        self.title.setWordWrap(True)  # so that the window may be narrow
        self.plot = _Plot(theme)
        self.plot.setMinimumSize(130, 110)
        item = self.plot.getPlotItem()
        item.getAxis("left").setWidth(_AXIS_WIDTH)
        for name, role in roles.items():
            self.plot.add_curve(name, Line(role))
        in_column(self.title, (self.plot, 1), on=self, margins=0, spacing=2)
        self._write()

    def draw(self, name: str, x: FloatArray, y: FloatArray) -> None:
        """Draw a curve (n,)."""
        self.plot.draw(name, x, y)

    def clear(self) -> None:
        """Draw nothing."""
        for name in self._roles:
            self.plot.clear_signal(name)

    def set_unit(self, unit: str) -> None:
        """Name the unit, "m" or "rad", of what is drawn in millionths of it."""
        self._unit = unit
        self._write()

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self.plot.set_theme(theme)
        self._write()

    def _write(self) -> None:
        """Write the names of axes and curves."""
        title, bottom = (
            tr(text).format(unit=f"µ{self._unit}") for text in (self._title, self._bottom)
        )
        self.plot.getPlotItem().setLabel("bottom", bottom)
        shown = ((tr(name), role) for name, role in self._roles.items())
        self.title.setText(f"{escape(title)}: {legend(self._theme, shown)}")


class CheckView(QWidget):
    """All kinds side by side on unseen rows, the reason, and the loop."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.table = Table(
            tr("Residual of each inverse on validation rows"),
            [tr(text) for text in HEAD],
            choose=False,
        )
        self.why = plain_text(tr(NOTHING), quiet=False, wrap=True)
        roles = {_POSITION: "quiet", _INVERTED: "accent"}
        self.loop = Curves(
            theme,
            mark("Validation rows, over the command [{unit}]"),
            roles,
            mark("command [{unit}]"),
        )
        in_row((in_column((self.table, 1), self.why), 3), (self.loop, 2), on=self, margins=0)

    def set_unit(self, unit: str) -> None:
        """Name the unit, "m" or "rad", of what will be drawn."""
        self.loop.set_unit(unit)

    def show_learned(self, learned: Learned) -> None:
        """Show the figures of inverses, and the loop of the recommended one."""
        self.table.show_rows(judged(learned.trained))
        self.why.setText(reasons(learned.trained))
        self.loop.clear()
        self.loop.set_unit(next(iter(learned.trained.models.values())).unit)
        loop = learned.loops.get(learned.trained.chosen)
        if loop is not None:
            self.loop.draw(_POSITION, _MICRO * loop.command, _MICRO * loop.position)
            self.loop.draw(_INVERTED, _MICRO * loop.command, _MICRO * loop.inverted)

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self.loop.set_theme(theme)


class LiveView(QWidget):
    """The loops of the trial motion without help, with the inverse, with feedback, with both."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        names = zip(Aid, ("quiet", "accent", "warning", "good"), strict=True)
        roles = {one.value: role for one, role in names}
        self.loop = Curves(
            theme, mark("Reading over reference [{unit}]"), roles, mark("reference [{unit}]")
        )
        self.left = Curves(
            theme,
            mark("Reading − reference, mean removed [{unit}]"),
            roles,
            mark("reference [{unit}]"),
        )
        in_row((self.loop, 1), (self.left, 1), on=self, margins=0)

    def set_unit(self, unit: str) -> None:
        """Name the unit, "m" or "rad", of what will be drawn."""
        self.loop.set_unit(unit)
        self.left.set_unit(unit)

    def show_trial(self, trial: Trial, unit: str) -> None:
        """Draw a trial beside the other one."""
        self.set_unit(unit)
        name = trial.by.value
        wanted, left = _MICRO * trial.wanted, trial.position - trial.wanted
        self.loop.draw(name, wanted, _MICRO * trial.position)
        self.left.draw(name, wanted, _MICRO * (left - left.mean()))

    def clear(self) -> None:
        """Draw nothing."""
        self.loop.clear()
        self.left.clear()

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self.loop.set_theme(theme)
        self.left.set_theme(theme)


class FrontView(QWidget):
    """The front as it evolves, and step and triangle of the point that was clicked.

    Signals
    -------
    picked(int) : the number of a point.
    """

    picked = Signal(int)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._front: FloatArray = np.zeros((0, 2))
        self._marked: int | None = None
        roles = {_FRONT: "accent"}
        self.front = Curves(
            theme, mark("Effort [ranges/s] over tracking [%]"), roles, mark("tracking rms [%]")
        )
        self._dots = pg.ScatterPlotItem(size=8, pen=None)
        self._mark = pg.ScatterPlotItem(size=14, brush=None)
        self.front.plot.addItem(self._dots)
        self.front.plot.addItem(self._mark)
        self.front.plot.setToolTip(tr("Click a point to simulate its step and triangle"))
        self.front.plot.setAccessibleName(tr("Pareto front"))
        self.front.plot.scene().sigMouseClicked.connect(self._clicked)
        tries = {_WANTED: "quiet", _POSITION: "accent"}
        self.step = Curves(theme, mark("Step [{unit}]"), tries, mark("time [ms]"))
        self.triangle = Curves(theme, mark("Triangle [{unit}]"), tries, mark("time [ms]"))
        in_row((self.front, 1), (self.step, 1), (self.triangle, 1), on=self, margins=0)
        self.set_theme(theme)

    def set_unit(self, unit: str) -> None:
        """Name the unit, "m" or "rad", of what will be drawn."""
        self.step.set_unit(unit)
        self.triangle.set_unit(unit)

    def show_generation(self, found: Generation, against: SecondObjective) -> None:
        """Draw the front of a search that continues."""
        points = [objectives_of(one.figures, against) for one in found.front]
        self._draw(np.array(points).reshape(-1, 2))
        self._mark.setData([], [])

    def show_tuning(self, tuning: Tuning) -> None:
        """Draw a result."""
        against = tuning.provenance.against
        self._draw(np.array([objectives_of(one.figures, against) for one in tuning.points]))

    def mark(self, number: int) -> None:
        """Mark a point."""
        x, y = self._front[number]
        self._mark.setData([100.0 * x], [y])

    def show_tries(self, step: Evaluation, triangle: Evaluation, unit: str) -> None:
        """Draw how the loop answers."""
        self.set_unit(unit)
        for view, one in ((self.step, step), (self.triangle, triangle)):
            time_ms = 1e3 * one.traces.time_s
            view.draw(_WANTED, time_ms, _MICRO * one.traces.reference)
            view.draw(_POSITION, time_ms, _MICRO * one.traces.position)

    def nearest(self, x: float, y: float) -> int | None:
        """Return the number of the point next to a place of the plot; None: none is near."""
        if not len(self._front):
            return None
        size = self.front.plot.getViewBox().viewPixelSize()
        apart = (self._front * (100.0, 1.0) - (x, y)) / size
        distance = np.hypot(*apart.T)
        number = int(np.argmin(distance))
        return number if distance[number] <= _NEAR_PX else None

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        for view in (self.front, self.step, self.triangle):
            view.set_theme(theme)
        self._dots.setBrush(QColor(theme.accent))
        self._mark.setPen(pg.mkPen(QColor(theme.text), width=2))

    def _draw(self, front: FloatArray) -> None:
        self._front = front
        self._dots.setData(100.0 * front[:, 0], front[:, 1])
        self.front.draw(_FRONT, 100.0 * front[:, 0], front[:, 1])

    def _clicked(self, event: "pg.GraphicsScene.mouseEvents.MouseClickEvent") -> None:
        place = self.front.plot.getViewBox().mapSceneToView(event.scenePos())
        number = self.nearest(place.x(), place.y())
        if number is not None:
            self.picked.emit(number)
