"""Readouts of the run, figures of the plan, and a button that switches the tool."""

from collections.abc import Mapping

from PySide6.QtWidgets import QProgressBar, QPushButton, QWidget

from rotemina.app.motion.penetration import (
    RUNNING_PHASES,
    PenetrationParameters,
    PenetrationPhase,
    PenetrationStatus,
)
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import STALE_AGE_S
from rotemina.app.widgets.controls import (
    enable_unless,
    name_widget,
    set_bar_value,
    show_tooltip,
)
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.text import ValueGrid, make_heading
from rotemina.app.workbench import Workbench
from rotemina.plugins.penetration import mark, tr
from rotemina.plugins.penetration.plan_preview import UNKNOWN_TEXT, PlanPreview, format_distance
from rotemina.sim.messages import format_fixed

_PLAN_FIGURES = {
    mark("Average speed"): mark("Depth over duration"),
    mark("Peak speed"): mark("Maximum instantaneous speed of the thrust"),
    mark("End depth"): mark(
        "Commanded end of the thrust, from the position of rest on the membrane"
    ),
    mark("Travel needed"): mark("Approach, halt and thrust together"),
    mark("Travel available"): mark(
        "Travel from the present position to the end of the range, towards the cell"
    ),
}
_RUN_FIGURES = {
    mark("Distance"): mark("Commanded distance from the start of the run"),
    mark("Deviation"): mark(
        "Change of measured − model since the start of the run, opposite to the motion"
    ),
}


class PenetrationReadouts(QWidget):
    """Readouts of the run and figures of the plan."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self.plan = _make_grid(_PLAN_FIGURES, "50000 µm/s")
        self.run = _make_grid(_RUN_FIGURES, "−2000.00 µm")
        self.load = name_widget(QProgressBar(), tr("Load, up to the overload"))
        self.load.setRange(0, 1000)
        self.load.setMinimumWidth(144)
        self.tool = QPushButton()
        self.tool.setCheckable(True)
        self.tool.clicked.connect(self._toggle_tool)
        column = make_column(make_heading(tr("Run")), self.run, self.load, self.tool, 1, spacing=4)
        plan_column = make_column(make_heading(tr("Plan")), self.plan, 1, spacing=4)
        make_row((column, 1), (plan_column, 1), on=self, margins=0, spacing=14)

    def show_plan(self, preview: PlanPreview, state: SessionState) -> None:
        """Show the figures of a plan for the current position of the axis."""
        start = state.command.get(preview.parameters.axis) if state.position_known else None
        self.plan.show_values(*preview.format_figures(self._workbench.robot, start))

    def refresh(
        self, status: PenetrationStatus, state: SessionState, parameters: PenetrationParameters
    ) -> None:
        """Show the status of a run with these parameters."""
        is_running, is_held = status.phase in RUNNING_PHASES, status.phase is PenetrationPhase.HELD
        distance = status.travel if is_running or is_held else None
        deviation, load = (status.deviation, status.load) if is_running else (None, None)
        self.run.show_values(
            UNKNOWN_TEXT if distance is None else format_distance(distance),
            UNKNOWN_TEXT if deviation is None else format_distance(deviation),
        )
        self.run.set_stale(state.age_s is None or state.age_s > STALE_AGE_S)
        overload = parameters.overload
        load_ratio = 0.0 if load is None else min(load / overload, 1.0)
        set_bar_value(self.load, round(1000 * load_ratio))
        value = UNKNOWN_TEXT if load is None else format_fixed(1e6 * load, 2)
        self.load.setFormat(
            tr("load {value} of {most:.4g} µm").format(value=value, most=1e6 * overload)
        )
        show_tooltip(
            self.load,
            tr("Deviation of the axis from its set-point."),
            tr("Above {most:.4g} µm the run fails and the tip retracts.").format(
                most=1e6 * overload
            ),
        )
        self._show_tool(status, state)

    def _show_tool(self, status: PenetrationStatus, state: SessionState) -> None:
        is_on = self._workbench.session.tool.is_on
        self.tool.setChecked(bool(is_on))
        self.tool.setText(tr("Tool is on") if is_on else tr("Tool is off"))
        objection = None
        if is_on is None:
            self.tool.setText(tr("No tool"))
            objection = tr("{driver} has no switchable tool").format(
                driver=self._workbench.session.driver.name
            )
        elif not is_on and status.phase in RUNNING_PHASES:
            objection = tr("the running penetration controls the tool")
        elif not is_on:
            objection = state.lock_reason
        tooltip = tr("Switch the tool off") if is_on else tr("Switch the tool on")
        enable_unless(self.tool, objection, tooltip)

    def _toggle_tool(self) -> None:
        self._workbench.run_request(self._workbench.operation.toggle_tool)
        # The request may have been refused, so the button shows the actual state.
        self.tool.setChecked(bool(self._workbench.session.tool.is_on))


def _make_grid(texts: Mapping[str, str], widest: str) -> ValueGrid:
    descriptions = {tr(name): tr(description) for name, description in texts.items()}
    return ValueGrid(descriptions, widest=widest, spacing=1)
