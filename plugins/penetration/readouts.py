"""Readouts during a run, the plan's figures before it, and the tool's switch."""

from collections.abc import Mapping

from PySide6.QtWidgets import QProgressBar, QPushButton, QWidget

from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.penetration.status import UNDER_WAY, PenetrationStatus, Phase
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import STALE_S
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import allow, fill, named, show_tip
from rotemina.app.widgets.figures import Figures
from rotemina.app.widgets.labels import heading
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.plugins.penetration import mark, tr
from rotemina.plugins.penetration.plan_preview import UNKNOWN, PlanPreview, way_text
from rotemina.sim.quantities import fixed

_PLAN = {
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
_RUN = {
    mark("Distance"): mark("Commanded distance from the start of the run"),
    mark("Deviation"): mark(
        "Change of measured − model since the start of the run, opposite to the motion"
    ),
}


class Readouts(QWidget):
    """Figures of the run and of the plan."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self.plan = _figures(_PLAN, "50000 µm/s")
        self.run = _figures(_RUN, "−2000.00 µm")
        self.load = named(QProgressBar(), tr("Load, up to the overload"))
        self.load.setRange(0, 1000)
        self.load.setMinimumWidth(144)
        self.tool = QPushButton()
        self.tool.setCheckable(True)
        self.tool.clicked.connect(self._toggle)
        column = in_column(heading(tr("Run")), self.run, self.load, self.tool, 1, spacing=4)
        beside = in_column(heading(tr("Plan")), self.plan, 1, spacing=4)
        in_row((column, 1), (beside, 1), on=self, margins=0, spacing=14)

    def show_plan(self, preview: PlanPreview, state: SessionState) -> None:
        """Show what a plan gives from where the axis stands."""
        start = state.command.get(preview.parameters.axis) if state.position_known else None
        self.plan.show_values(*preview.figures(self._workbench.robot, start))

    def refresh(
        self, status: PenetrationStatus, state: SessionState, parameters: PenetrationParameters
    ) -> None:
        """Show a moment of a run by some parameters."""
        running, held = status.phase in UNDER_WAY, status.phase is Phase.HELD
        way = status.way if running or held else None
        deviation, load = (status.deviation, status.load) if running else (None, None)
        self.run.show_values(
            UNKNOWN if way is None else way_text(way),
            UNKNOWN if deviation is None else way_text(deviation),
        )
        self.run.set_stale(state.age_s is None or state.age_s > STALE_S)
        most = parameters.overload
        share = 0.0 if load is None else min(load / most, 1.0)
        fill(self.load, round(1000 * share))
        value = UNKNOWN if load is None else fixed(1e6 * load, 2)
        self.load.setFormat(
            tr("load {value} of {most:.4g} µm").format(value=value, most=1e6 * most)
        )
        show_tip(
            self.load,
            tr("Deviation of the axis from its set-point."),
            tr("Above {most:.4g} µm the run fails and the tip retracts.").format(most=1e6 * most),
        )
        self._show_tool(status, state)

    def _show_tool(self, status: PenetrationStatus, state: SessionState) -> None:
        on = self._workbench.session.tool.on
        self.tool.setChecked(bool(on))
        self.tool.setText(tr("Tool is on") if on else tr("Tool is off"))
        why = None
        if on is None:
            self.tool.setText(tr("No tool"))
            why = tr("{driver} has no switchable tool").format(
                driver=self._workbench.session.driver.name
            )
        elif not on and status.phase in UNDER_WAY:
            why = tr("the running penetration controls the tool")
        elif not on:
            why = state.locked
        tip = tr("Switch the tool off") if on else tr("Switch the tool on")
        allow(self.tool, why, tip)

    def _toggle(self) -> None:
        self._workbench.ask(self._workbench.operation.toggle_tool)
        self.tool.setChecked(bool(self._workbench.session.tool.on))  # as it is, not as asked


def _figures(names: Mapping[str, str], widest: str) -> Figures:
    said = {tr(name): tr(about) for name, about in names.items()}
    return Figures(said, widest=widest, spacing=1)
