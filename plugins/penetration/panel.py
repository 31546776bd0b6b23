"""Panel for automatic cell penetration: parameters, run and log."""

import logging
from dataclasses import asdict
from pathlib import Path

from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QStackedWidget, QTabBar, QWidget

from rotemina.app.language import marked, translate_message
from rotemina.app.motion.penetration import PenetrationParameters, PenetrationRun, PenetrationStatus
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import (
    Panel,
    PanelArea,
    offer_in_palette,
)
from rotemina.app.shell.records import ask_file, ask_run_report, ask_save_path, find_recording
from rotemina.app.widgets.controls import name_widget
from rotemina.app.widgets.layout import fix_width, make_column, make_row, make_scroll_area
from rotemina.app.widgets.text import make_plain_label
from rotemina.app.workbench import BackgroundWorker, Level, Workbench
from rotemina.plugins.penetration import mark, tr
from rotemina.plugins.penetration.cell_list_view import CellListView
from rotemina.plugins.penetration.cell_view import SimulatedCellView
from rotemina.plugins.penetration.form import ParameterForm
from rotemina.plugins.penetration.past_runs_view import PastRunsView
from rotemina.plugins.penetration.plan_preview import PlanPreview
from rotemina.plugins.penetration.readouts import PenetrationReadouts
from rotemina.plugins.penetration.run_bar import RunBar
from rotemina.plugins.penetration.thrust_view import ThrustView
from rotemina.plugins.penetration.words import LOCKED_PHASES, describe_status

logger = logging.getLogger(__name__)

FILE_FILTER = mark("Penetrations (*.toml);;All files (*)")
_PLANNING_TEXT = mark("the thrust is being planned")
#: The parameters are saved this long after the latest change.
SAVE_DELAY_MS = 500


class PenetrationPanel(Panel):
    """Panel with buttons and phases at the top, and tabs for thrust, runs and cells below."""

    title = marked("panels", "Penetration")
    area = PanelArea.BOTTOM
    order = 35
    help_page = "penetration.md#in-the-window"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self._operation = workbench.operation
        self._penetration = self._operation.penetration
        self._arming_objection: str | None = None
        self._last_objection_inputs: object = ()
        self._shown_log_problem = ""
        self.bar = RunBar(workbench)
        self.message = name_widget(
            make_plain_label(quiet=False, lines=3), tr("State of the penetration")
        )
        self.form = ParameterForm(workbench.robot, self._operation.penetration_parameters)
        self._planner = BackgroundWorker(self)
        workbench.closing.connect(self._planner.discard_results)
        self._driver_of_plan = workbench.session.driver
        self.plan_preview = PlanPreview(self.form.parameters, None, tr(_PLANNING_TEXT))
        self.readouts, self.thrust_view = (
            PenetrationReadouts(workbench),
            ThrustView(workbench.theme),
        )
        self.log = PastRunsView(self._operation.penetration_log.path)
        self.simulated_cell, self.cell_list = SimulatedCellView(workbench), CellListView(workbench)
        self._save_timer = QTimer(self, interval=SAVE_DELAY_MS, singleShot=True)
        self._shown_curves: object = ()
        self._lay_out()
        self._connect()
        offer_in_palette(self.bar.arm, self.cell_list.next)
        offer_in_palette(self.cell_list.export, safe_while_hidden=True)
        self._read_log()
        self._make_first_plan()

    def _lay_out(self) -> None:
        thrust = QWidget()
        readouts = fix_width(make_scroll_area(self.readouts, min_width=0))
        make_row(readouts, (self.thrust_view, 1), self.form, on=thrust, margins=0, spacing=12)
        self.tabs, self.views = QTabBar(), QStackedWidget()
        for name, view in (
            (tr("Thrust"), thrust),
            (tr("Runs"), self.log),
            (tr("Simulated cell"), self.simulated_cell),
            (tr("Cells"), self.cell_list),
        ):
            self.tabs.addTab(name)
            self.views.addWidget(view)
        self.tabs.currentChanged.connect(self.views.setCurrentIndex)
        head_row = make_row((self.message, 1), spacing=10)
        head_row.addWidget(self.tabs, 0, Qt.AlignmentFlag.AlignTop)
        make_column(self.bar, head_row, (self.views, 1), on=self, margins=(10, 6, 10, 6), spacing=4)

    def _connect(self) -> None:
        self.bar.arm_asked.connect(self.arm)
        self.bar.prepare_asked.connect(self.prepare)
        self.cell_list.penetrate_asked.connect(self.arm_for_cell)
        self.log.report_asked.connect(self._ask_report)
        self.form.changed.connect(self._on_form_changed)
        self.form.load.clicked.connect(lambda _: self._ask_load())
        self.form.save.clicked.connect(lambda _: self._ask_save())
        self._save_timer.timeout.connect(self._autosave_parameters)
        self.follow(self._refresh)
        self.workbench.theme_changed.connect(self.thrust_view.set_theme)
        self.workbench.closing.connect(self._on_closing)

    def arm(self) -> bool:
        """Arm a penetration with the displayed parameters, and return whether that succeeded.

        A refusal is shown to the operator.
        """
        # A field may still be edited, and its text must not be ignored.
        self.form.read_fields()
        if self.form.complaint:
            self.workbench.refuse(self.form.complaint, about=self)
            return False
        parameters = self.form.parameters
        return self.workbench.run_request(lambda: self._operation.arm_penetration(parameters))

    def arm_for_cell(self) -> None:
        """Arm as :meth:`arm` does. The run will belong to the current cell of the list."""
        # The cell list needs the run before this one. A later status may already have the new run.
        status_before_arming = self._penetration.status
        if self.arm():
            self.cell_list.note_armed(status_before_arming)

    def prepare(self) -> None:
        """Move the nano stage back to gain the travel that the displayed parameters need.

        The micro stage compensates for the motion, so the tip stays in place.
        """
        parameters = self.form.parameters
        self.workbench.run_request(lambda: self._operation.prepare_penetration(parameters))

    def load_parameters(self, path: Path) -> None:
        """Load parameters from a file into the form."""

        def on_loaded(parameters: PenetrationParameters) -> None:
            if self._penetration.status.phase in LOCKED_PHASES:
                self.workbench.notify(
                    Level.WARNING,
                    tr("{name} is not applied: a penetration is armed or running.").format(
                        name=path.name
                    ),
                    about=self,
                    until=lambda _: self._penetration.status.phase not in LOCKED_PHASES,
                )
                return
            self.form.show_parameters(parameters)
            self._on_form_changed()

        self.workbench.read_file(
            "penetration", path.name, lambda: PenetrationParameters.load(path), on_loaded
        )

    def save_parameters(self, path: Path) -> None:
        """Write the parameters to a file."""
        self.form.read_fields()
        if self.form.complaint:
            text = tr("Not saved: {reason}").format(reason=self.form.complaint)
            self.workbench.refuse(text, about=self)
            return
        parameters = self.form.parameters
        self.workbench.write_file("save penetration", path, lambda: parameters.save(path))

    def _ask_load(self) -> None:
        ask_file(self, self.workbench, tr("Load parameters"), tr(FILE_FILTER), self.load_parameters)

    def _ask_save(self) -> None:
        title = tr("Save parameters")
        ask_save_path(
            self, self.workbench, title, tr(FILE_FILTER), "penetration.toml", self.save_parameters
        )

    def _on_form_changed(self) -> None:
        if not self.form.complaint and self.form.parameters != self.plan_preview.parameters:
            self._plan_thrust()
            self._save_timer.start()
        self._refresh(self.workbench.session.snapshot())

    def _make_first_plan(self) -> None:
        """Make the first plan in the background, so that the panel opens sooner."""
        session, placeholder = self.workbench.session, self.plan_preview

        def show_preview(preview: PlanPreview) -> None:
            # The parameters may have been changed meanwhile.
            if self.plan_preview is placeholder:
                self.plan_preview = preview
                self._refresh(session.snapshot())

        self._planner.run(
            "plan",
            lambda: PlanPreview.plan_for_session(session, placeholder.parameters),
            show_preview,
            logger.warning,
        )

    def _plan_thrust(self) -> None:
        session = self.workbench.session
        self._driver_of_plan = session.driver
        self.plan_preview = PlanPreview.plan_for_session(session, self.form.parameters)

    def _autosave_parameters(self) -> None:
        parameters = self.plan_preview.parameters
        self.workbench.run_request(lambda: self._operation.save_penetration_parameters(parameters))

    def _on_closing(self) -> None:
        if self._save_timer.isActive():
            self._save_timer.stop()
            self._autosave_parameters()

    def _refresh(self, state: SessionState) -> None:
        status = self._penetration.status
        self._update_plan_and_objection(status, state)
        self.bar.refresh(status, state, self._arming_objection)
        self.bar.offer_preparation(
            status.phase not in LOCKED_PHASES
            and self.plan_preview.lacks_room(self.workbench.robot, state),
            state,
        )
        self.simulated_cell.refresh(state, self.plan_preview.parameters)
        text = describe_status(status, self._arming_objection)
        if (
            self.simulated_cell.is_missing
            and self._arming_objection is None
            and status.phase not in LOCKED_PHASES
        ):
            text += tr(" The simulator has no cell: place one in Simulated cell.")
        if self.message.text() != text:
            self.message.setText(text)
        self.readouts.refresh(status, state, self.plan_preview.parameters)
        self.cell_list.refresh(state, status, self._arming_objection)
        self._draw_thrust(status)
        form_objection = None
        if status.phase in LOCKED_PHASES:
            form_objection = tr("the penetration is armed or running; disarm it first")
        self.form.allow_changes_unless(form_objection)
        self.log.add_latest(status.run)
        if status.log_problem != self._shown_log_problem:
            self._shown_log_problem = status.log_problem
            if status.log_problem:
                self.workbench.notify(
                    Level.WARNING,
                    tr("The run was not logged: {problem}").format(problem=status.log_problem),
                    about=self,
                )

    def _update_plan_and_objection(self, status: PenetrationStatus, state: SessionState) -> None:
        session = self.workbench.session
        # The set-point period may differ between drivers, and the plan depends on it.
        if session.driver is not self._driver_of_plan:
            self._plan_thrust()
        inputs = (
            self.plan_preview,
            self.form.complaint,
            status.phase,
            dict(state.command),
            state.lock_reason,
            state.activity,
            state.queued > 0,
            dict(state.owners),
            session.bounds.keep_out,
        )
        if inputs == self._last_objection_inputs:
            return
        self._last_objection_inputs = inputs
        self.readouts.show_plan(self.plan_preview, state)
        if self.form.complaint or self.plan_preview.plan is None:
            self._arming_objection = self.form.complaint or self.plan_preview.problem
        elif state.lock_reason is not None:
            self._arming_objection = tr("motion is locked: {locked}").format(
                locked=translate_message(state.lock_reason)
            )
        else:
            self._arming_objection = self._penetration.find_refusal_reason(
                self.plan_preview.parameters, self.plan_preview.plan
            )

    def _draw_thrust(self, status: PenetrationStatus) -> None:
        """Draw the plan, and the latest run if it used the same parameters."""
        curves = (self.plan_preview, status.trace, status.run)
        if curves == self._shown_curves:
            return
        self._shown_curves = curves
        self.thrust_view.show_plan(
            self.plan_preview.plan,
            status.trace if _was_run_with(status.run, self.plan_preview.parameters) else None,
        )

    def _ask_report(self, run: PenetrationRun) -> None:
        entry = find_recording(self.workbench.library.entries, run)
        if entry is None:
            text = tr("The library has no recording of this run.")
            self.workbench.notify(Level.WARNING, text, about=self)
        else:
            ask_run_report(self, self.workbench, entry)

    def _read_log(self) -> None:
        log = self._operation.penetration_log
        if not Path(log.path).exists():
            return

        def on_read(answer: tuple[tuple[PenetrationRun, ...], tuple[str, ...]]) -> None:
            runs, problems = answer
            self.log.add_logged(runs)
            if problems:
                self.workbench.notify(
                    Level.WARNING,
                    tr("{n} lines of the log cannot be read: {first}").format(
                        n=len(problems), first=problems[0]
                    ),
                    about=self,
                )

        self.workbench.work("penetration log", tr("Reading the log …"), log.read, on_read)


def _was_run_with(run: PenetrationRun | None, parameters: PenetrationParameters) -> bool:
    return run is not None and run.parameters == asdict(parameters)
