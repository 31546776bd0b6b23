"""Plots of hysteresis loops, of the Pareto front of a search, and of closed-loop responses."""

from html import escape

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QLabel, QWidget

from rotemina.app.widgets.drawing import LineStyle, SignalPlot
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.style import Theme
from rotemina.app.widgets.text import TextTable, make_colour_legend, make_plain_label
from rotemina.plugins.compensation import mark, tr
from rotemina.plugins.compensation.inverse_training import TrainedInverses
from rotemina.plugins.compensation.trial_motion import CompensationMode, CompensationTrial
from rotemina.plugins.compensation.words import (
    INVERSE_HEADINGS,
    NO_INVERSE,
    explain_recommendation,
    make_residual_rows,
)
from rotemina.sim.arrays import FloatArray
from rotemina.sim.tuning import (
    ScenarioEvaluation,
    SearchGeneration,
    SecondObjective,
    TuningResult,
    compute_objectives,
)

_POSITION_CURVE, _DESIRED_CURVE = mark("position"), mark("desired")
_INVERSE_CURVE, _FRONT_CURVE = mark("inverse model"), mark("front")
_MICRO_PER_SI = 1e6
_AXIS_WIDTH_PX = 52

# A click chooses the nearest point within this distance.
_MAX_CLICK_DISTANCE_PX = 40.0


class _FullCurvePlot(SignalPlot):
    def draw(self, name: str, x: FloatArray, y: FloatArray) -> None:
        """Draw a curve without downsampling, which would break up a loop.

        ``x`` and ``y`` have shape (n,).
        """
        self._draw(name, x, y)
        self.autoRange(padding=0.04)


class CurvePlot(QWidget):
    """Plot with a title and a colour legend above it.

    Parameters
    ----------
    theme : Theme
    title : str
        May contain ``{unit}``. Titles and names are marked texts, which are translated here.
    roles : mapping of str to str
        Colour role of each curve, by the name of the curve.
    bottom : str
        Title of the horizontal axis. May contain ``{unit}``.
    """

    def __init__(self, theme: Theme, title: str, roles: dict[str, str], bottom: str) -> None:
        super().__init__()
        self._title, self._roles, self._bottom = title, roles, bottom
        self._theme, self._unit = theme, ""
        self.title = QLabel()
        self.title.setTextFormat(Qt.TextFormat.RichText)
        # The title must not limit how narrow the window can be.
        self.title.setWordWrap(True)
        self.plot = _FullCurvePlot(theme)
        self.plot.setMinimumSize(130, 110)
        item = self.plot.getPlotItem()
        item.getAxis("left").setWidth(_AXIS_WIDTH_PX)
        for name, role in roles.items():
            self.plot.add_curve(name, LineStyle(role))
        make_column(self.title, (self.plot, 1), on=self, margins=0, spacing=2)
        self._write_titles()

    def draw(self, name: str, x: FloatArray, y: FloatArray) -> None:
        """Draw the curve ``name``. ``x`` and ``y`` have shape (n,)."""
        self.plot.draw(name, x, y)

    def clear(self) -> None:
        """Clear all curves."""
        for name in self._roles:
            self.plot.clear_signal(name)

    def set_unit(self, unit: str) -> None:
        """Set the SI unit, "m" or "rad". Titles show µm or µrad, in which curves must be drawn."""
        self._unit = unit
        self._write_titles()

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self.plot.set_theme(theme)
        self._write_titles()

    def _write_titles(self) -> None:
        title, bottom = (
            tr(text).format(unit=f"µ{self._unit}") for text in (self._title, self._bottom)
        )
        self.plot.getPlotItem().setLabel("bottom", bottom)
        names_and_roles = ((tr(name), role) for name, role in self._roles.items())
        self.title.setText(f"{escape(title)}: {make_colour_legend(self._theme, names_and_roles)}")


class CheckView(QWidget):
    """Residuals of all inverses in the validation, and the loop of the recommended one."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.table = TextTable(
            tr("Residual of each inverse on validation rows"),
            [tr(text) for text in INVERSE_HEADINGS],
            selectable=False,
        )
        self.why = make_plain_label(tr(NO_INVERSE), quiet=False, wrap=True)
        roles = {_POSITION_CURVE: "quiet", _INVERSE_CURVE: "accent"}
        self.loop = CurvePlot(
            theme,
            mark("Validation data against the command [{unit}]"),
            roles,
            mark("command [{unit}]"),
        )
        make_row((make_column((self.table, 1), self.why), 3), (self.loop, 2), on=self, margins=0)

    def set_unit(self, unit: str) -> None:
        """Set the SI unit of the curves, "m" or "rad"."""
        self.loop.set_unit(unit)

    def show_inverses(self, inverses: TrainedInverses) -> None:
        """Show the figures of all inverses, and the loop of the recommended one."""
        self.table.show_rows(make_residual_rows(inverses.trained))
        self.why.setText(explain_recommendation(inverses.trained))
        self.loop.clear()
        self.loop.set_unit(next(iter(inverses.trained.models.values())).unit)
        loop = inverses.loops.get(inverses.trained.recommended_kind)
        if loop is not None:
            self.loop.draw(
                _POSITION_CURVE, _MICRO_PER_SI * loop.command, _MICRO_PER_SI * loop.position
            )
            self.loop.draw(
                _INVERSE_CURVE, _MICRO_PER_SI * loop.command, _MICRO_PER_SI * loop.inverted
            )

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self.loop.set_theme(theme)


class LiveView(QWidget):
    """Trials without compensation, with the inverse, with feedback, and with both."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        modes_and_roles = zip(CompensationMode, ("quiet", "accent", "warning", "good"), strict=True)
        roles = {mode.value: role for mode, role in modes_and_roles}
        self.loop = CurvePlot(
            theme, mark("Reading against reference [{unit}]"), roles, mark("reference [{unit}]")
        )
        self.error = CurvePlot(
            theme,
            mark("Reading − reference, mean removed [{unit}]"),
            roles,
            mark("reference [{unit}]"),
        )
        make_row((self.loop, 1), (self.error, 1), on=self, margins=0)

    def set_unit(self, unit: str) -> None:
        """Set the SI unit of the curves, "m" or "rad"."""
        self.loop.set_unit(unit)
        self.error.set_unit(unit)

    def show_trial(self, trial: CompensationTrial, unit: str) -> None:
        """Draw a trial. The curves of other modes stay."""
        self.set_unit(unit)
        name = trial.mode.value
        reference, error = _MICRO_PER_SI * trial.reference, trial.position - trial.reference
        self.loop.draw(name, reference, _MICRO_PER_SI * trial.position)
        self.error.draw(name, reference, _MICRO_PER_SI * (error - error.mean()))

    def clear(self) -> None:
        """Clear all curves."""
        self.loop.clear()
        self.error.clear()

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self.loop.set_theme(theme)
        self.error.set_theme(theme)


class ParetoFrontView(QWidget):
    """View of the Pareto front, and of the responses of the point that was clicked.

    Signals
    -------
    picked(int) : index of the point that was clicked.
    """

    picked = Signal(int)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._front: FloatArray = np.zeros((0, 2))
        roles = {_FRONT_CURVE: "accent"}
        self.front = CurvePlot(
            theme,
            mark("Control effort [ranges/s] against tracking error [%]"),
            roles,
            mark("rms tracking error [%]"),
        )
        self._dots = pg.ScatterPlotItem(size=8, pen=None)
        self._selection_marker = pg.ScatterPlotItem(size=14, brush=None)
        self.front.plot.addItem(self._dots)
        self.front.plot.addItem(self._selection_marker)
        self.front.plot.setToolTip(tr("Click a point to simulate its step and triangle responses"))
        self.front.plot.setAccessibleName(tr("Pareto front"))
        self.front.plot.scene().sigMouseClicked.connect(self._on_click)
        response_roles = {_DESIRED_CURVE: "quiet", _POSITION_CURVE: "accent"}
        self.step = CurvePlot(theme, mark("Step [{unit}]"), response_roles, mark("time [ms]"))
        self.triangle = CurvePlot(
            theme, mark("Triangle [{unit}]"), response_roles, mark("time [ms]")
        )
        make_row((self.front, 1), (self.step, 1), (self.triangle, 1), on=self, margins=0)
        self.set_theme(theme)

    def set_unit(self, unit: str) -> None:
        """Set the SI unit of the curves, "m" or "rad"."""
        self.step.set_unit(unit)
        self.triangle.set_unit(unit)

    def show_generation(
        self, generation: SearchGeneration, second_objective: SecondObjective
    ) -> None:
        """Draw the front of a running search."""
        points = [compute_objectives(point.figures, second_objective) for point in generation.front]
        self._draw_front(np.array(points).reshape(-1, 2))
        self._selection_marker.setData([], [])

    def show_tuning(self, tuning: TuningResult) -> None:
        """Draw the front of a finished search."""
        second_objective = tuning.provenance.against
        self._draw_front(
            np.array(
                [compute_objectives(point.figures, second_objective) for point in tuning.points]
            )
        )

    def clear_front(self) -> None:
        """Remove the front and the mark of the selected point."""
        self._draw_front(np.zeros((0, 2)))
        self._selection_marker.setData([], [])

    def highlight_point(self, index: int) -> None:
        """Mark the selected point."""
        x, y = self._front[index]
        self._selection_marker.setData([100.0 * x], [y])

    def show_responses(
        self, step: ScenarioEvaluation, triangle: ScenarioEvaluation, unit: str
    ) -> None:
        """Draw the closed-loop responses to a step and a triangle."""
        self.set_unit(unit)
        for view, evaluation in ((self.step, step), (self.triangle, triangle)):
            time_ms = 1e3 * evaluation.traces.time_s
            view.draw(_DESIRED_CURVE, time_ms, _MICRO_PER_SI * evaluation.traces.reference)
            view.draw(_POSITION_CURVE, time_ms, _MICRO_PER_SI * evaluation.traces.position)

    def find_nearest(self, x: float, y: float) -> int | None:
        """Return the index of the point nearest to (x, y) in the plot, or None if none is close."""
        if not len(self._front):
            return None
        size = self.front.plot.getViewBox().viewPixelSize()
        offset_px = (self._front * (100.0, 1.0) - (x, y)) / size
        distance = np.hypot(*offset_px.T)
        index = int(np.argmin(distance))
        return index if distance[index] <= _MAX_CLICK_DISTANCE_PX else None

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        for view in (self.front, self.step, self.triangle):
            view.set_theme(theme)
        self._dots.setBrush(QColor(theme.accent))
        self._selection_marker.setPen(pg.mkPen(QColor(theme.text), width=2))

    def _draw_front(self, front: FloatArray) -> None:
        self._front = front
        self._dots.setData(100.0 * front[:, 0], front[:, 1])
        self.front.draw(_FRONT_CURVE, 100.0 * front[:, 0], front[:, 1])

    def _on_click(self, event: "pg.GraphicsScene.mouseEvents.MouseClickEvent") -> None:
        position = self.front.plot.getViewBox().mapSceneToView(event.scenePos())
        index = self.find_nearest(position.x(), position.y())
        if index is not None:
            self.picked.emit(index)
