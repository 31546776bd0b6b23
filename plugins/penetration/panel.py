"""Automatic cell penetration: parameters, the run, and the log."""

import logging
from dataclasses import asdict
from pathlib import Path

from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QStackedWidget, QTabBar, QWidget

from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.penetration.run_log import PenetrationRun
from rotemina.app.motion.penetration.status import PenetrationStatus
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import Area, Panel, offer_in_palette
from rotemina.app.shell.background import Background
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.file_dialog import ask_file, ask_where
from rotemina.app.shell.language import marked
from rotemina.app.shell.report_files import ask_run_report, recording_of
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import named
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.app.widgets.scroll_areas import keeping_width, scrolled
from rotemina.plugins.penetration import mark, tr
from rotemina.plugins.penetration.cell_list_view import CellListView
from rotemina.plugins.penetration.cell_view import CellView
from rotemina.plugins.penetration.form import ParameterForm
from rotemina.plugins.penetration.past_runs_view import LogView
from rotemina.plugins.penetration.plan_preview import PlanPreview
from rotemina.plugins.penetration.readouts import Readouts
from rotemina.plugins.penetration.run_bar import RunBar
from rotemina.plugins.penetration.thrust_view import ThrustPreview
from rotemina.plugins.penetration.words import FIXED, message

logger = logging.getLogger(__name__)

FILES = mark("Penetrations (*.toml);;All files (*)")
_PLANNING = mark("the thrust is being planned")
KEEP_MS = 500  # after the latest change the parameters are kept


class PenetrationPanel(Panel):
    """Buttons and phases above; below the thrust, the log, and a simulated cell."""

    title = marked("panels", "Penetration")
    area = Area.BOTTOM
    order = 35
    help_page = "penetration.md#in-the-window"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self._operation = workbench.operation
        self._penetration = self._operation.penetration
        self._why_not: str | None = None
        self._last_inputs: object = ()
        self._problem = ""
        self.bar = RunBar(workbench)
        self.message = named(plain_text(quiet=False, lines=3), tr("State of the penetration"))
        self.form = ParameterForm(workbench.robot, self._operation.penetration_parameters)
        self._planning = Background(self)
        workbench.closing.connect(self._planning.drop_answers)
        self._planned_for = workbench.session.driver
        self.plan_preview = PlanPreview(self.form.parameters, None, tr(_PLANNING))
        self.readouts, self.preview = Readouts(workbench), ThrustPreview(workbench.theme)
        self.log = LogView(self._operation.penetration_log.path)
        self.cell, self.cells = CellView(workbench), CellListView(workbench)
        self._keep = QTimer(self, interval=KEEP_MS, singleShot=True)
        self._shown_trace: object = ()
        self._lay_out()
        self._connect()
        offer_in_palette(self.bar.arm, self.cells.next)
        offer_in_palette(self.cells.export, safe_while_hidden=True)
        self._read_log()
        self._plan_first()

    # --- parts ------------------------------------------------------------------------------------

    def _lay_out(self) -> None:
        thrust = QWidget()
        beside = keeping_width(scrolled(self.readouts, least=0))
        in_row(beside, (self.preview, 1), self.form, on=thrust, margins=0, spacing=12)
        self.tabs, self.views = QTabBar(), QStackedWidget()
        for name, view in (
            (tr("Thrust"), thrust),
            (tr("Runs"), self.log),
            (tr("Simulated cell"), self.cell),
            (tr("Cells"), self.cells),
        ):
            self.tabs.addTab(name)
            self.views.addWidget(view)
        self.tabs.currentChanged.connect(self.views.setCurrentIndex)
        head = in_row((self.message, 1), spacing=10)
        head.addWidget(self.tabs, 0, Qt.AlignmentFlag.AlignTop)
        in_column(self.bar, head, (self.views, 1), on=self, margins=(10, 6, 10, 6), spacing=4)

    def _connect(self) -> None:
        self.bar.arm_asked.connect(self.arm)
        self.bar.prepare_asked.connect(self.prepare)
        self.cells.penetrate_asked.connect(self.arm_for_cell)
        self.log.report_asked.connect(self._report)
        self.form.changed.connect(self._change)
        self.form.load.clicked.connect(lambda _: self._ask_load())
        self.form.save.clicked.connect(lambda _: self._ask_save())
        self._keep.timeout.connect(self._keep_parameters)
        self.follow(self._refresh)
        self.workbench.theme_changed.connect(self.preview.set_theme)
        self.workbench.closing.connect(self._close)

    # --- what the operator does -------------------------------------------------------------------

    def arm(self) -> bool:
        """Arm the parameters as they are shown, or say why not; return whether it was done."""
        self.form.take()  # a field that is still being edited counts too
        if self.form.complaint:
            self.workbench.refuse(self.form.complaint, about=self)
            return False
        parameters = self.form.parameters
        return self.workbench.ask(lambda: self._operation.arm_penetration(parameters))

    def arm_for_cell(self) -> None:
        """Arm as :meth:`arm` does; what comes of it is that of the list's present cell."""
        status = self._penetration.status
        if self.arm():
            self.cells.armed(status)

    def prepare(self) -> None:
        """Move the nano stage back as far as the parameters need; the tip stays."""
        parameters = self.form.parameters
        self.workbench.ask(lambda: self._operation.prepare_penetration(parameters))

    def load_parameters(self, path: Path) -> None:
        """Take parameters from a file."""

        def done(parameters: PenetrationParameters) -> None:
            if self._penetration.status.phase in FIXED:
                self.workbench.notify(
                    Level.WARNING,
                    tr("{name} is not applied: a penetration is armed or running.").format(
                        name=path.name
                    ),
                    about=self,
                    until=lambda _: self._penetration.status.phase not in FIXED,
                )
                return
            self.form.show_parameters(parameters)
            self._change()

        self.workbench.read_file(
            "penetration", path.name, lambda: PenetrationParameters.load(path), done
        )

    def save_parameters(self, path: Path) -> None:
        """Write the parameters to a file."""
        self.form.take()
        if self.form.complaint:
            text = tr("Not saved: {reason}").format(reason=self.form.complaint)
            self.workbench.refuse(text, about=self)
            return
        parameters = self.form.parameters
        self.workbench.write_file("save penetration", path, lambda: parameters.save(path))

    def _ask_load(self) -> None:
        ask_file(self, self.workbench, tr("Load parameters"), tr(FILES), self.load_parameters)

    def _ask_save(self) -> None:
        title = tr("Save parameters")
        ask_where(self, self.workbench, title, tr(FILES), "penetration.toml", self.save_parameters)

    # --- parameters -------------------------------------------------------------------------------

    def _change(self) -> None:
        """Plan again, and keep the parameters a little later."""
        if not self.form.complaint and self.form.parameters != self.plan_preview.parameters:
            self._plan()
            self._keep.start()
        self._refresh(self.workbench.session.snapshot())

    def _plan_first(self) -> None:
        """Plan in the background: to make the panel takes long enough."""
        session, awaited = self.workbench.session, self.plan_preview

        def take(preview: PlanPreview) -> None:
            if self.plan_preview is awaited:  # nothing was changed meanwhile
                self.plan_preview = preview
                self._refresh(session.snapshot())

        self._planning.run(
            "plan", lambda: PlanPreview.of(session, awaited.parameters), take, logger.warning
        )

    def _plan(self) -> None:
        session = self.workbench.session
        self._planned_for = session.driver
        self.plan_preview = PlanPreview.of(session, self.form.parameters)

    def _keep_parameters(self) -> None:
        parameters = self.plan_preview.parameters
        self.workbench.ask(lambda: self._operation.keep_penetration(parameters))

    def _close(self) -> None:
        if self._keep.isActive():
            self._keep.stop()
            self._keep_parameters()

    # --- what is shown ----------------------------------------------------------------------------

    def _refresh(self, state: SessionState) -> None:
        status = self._penetration.status
        self._look(status, state)
        self.bar.refresh(status, state, self._why_not)
        self.bar.offer_preparing(
            status.phase not in FIXED and self.plan_preview.lacks_room(self.workbench.robot, state),
            state,
        )
        self.cell.refresh(state, self.plan_preview.parameters)
        text = message(status, self._why_not)
        if self.cell.missing and self._why_not is None and status.phase not in FIXED:
            text += tr(" The simulator has no cell: place one in Simulated cell.")
        if self.message.text() != text:
            self.message.setText(text)
        self.readouts.refresh(status, state, self.plan_preview.parameters)
        self.cells.refresh(state, status, self._why_not)
        self._draw(status)
        fixed = None
        if status.phase in FIXED:
            fixed = tr("the penetration is armed or running; disarm it first")
        self.form.allow(fixed)
        self.log.take_latest(status.run)
        if status.problem != self._problem:
            self._problem = status.problem
            if status.problem:
                self.workbench.notify(
                    Level.WARNING,
                    tr("The run was not logged: {problem}").format(problem=status.problem),
                    about=self,
                )

    def _look(self, status: PenetrationStatus, state: SessionState) -> None:
        """Find out why it cannot be armed now, when anything has changed that counts."""
        session = self.workbench.session
        if session.driver is not self._planned_for:  # another one may hold its set-points longer
            self._plan()
        inputs = (
            self.plan_preview,
            self.form.complaint,
            status.phase,
            dict(state.command),
            state.locked,
            state.activity,
            state.queued > 0,
            dict(state.owners),
            session.bounds.keep_out,
        )
        if inputs == self._last_inputs:
            return
        self._last_inputs = inputs
        self.readouts.show_plan(self.plan_preview, state)
        if self.form.complaint or self.plan_preview.plan is None:
            self._why_not = self.form.complaint or self.plan_preview.problem
        elif state.locked is not None:
            self._why_not = tr("motion is locked: {locked}").format(locked=spoken(state.locked))
        else:
            self._why_not = self._penetration.why_not(
                self.plan_preview.parameters, self.plan_preview.plan
            )

    def _draw(self, status: PenetrationStatus) -> None:
        """Draw the plan; beside it the latest run, where that was by these parameters."""
        shown = (self.plan_preview, status.trace, status.run)
        if shown == self._shown_trace:
            return
        self._shown_trace = shown
        self.preview.show_plan(
            self.plan_preview.plan,
            status.trace if _by(status.run, self.plan_preview.parameters) else None,
        )

    def _report(self, run: PenetrationRun) -> None:
        entry = recording_of(self.workbench.library.entries, run)
        if entry is None:
            text = tr("The library has no recording of this run.")
            self.workbench.notify(Level.WARNING, text, about=self)
        else:
            ask_run_report(self, self.workbench, entry)

    def _read_log(self) -> None:
        log = self._operation.penetration_log
        if not Path(log.path).exists():
            return

        def done(read: tuple[tuple[PenetrationRun, ...], tuple[str, ...]]) -> None:
            runs, problems = read
            self.log.take_file(runs)
            if problems:
                self.workbench.notify(
                    Level.WARNING,
                    tr("{n} lines of the log cannot be read: {first}").format(
                        n=len(problems), first=problems[0]
                    ),
                    about=self,
                )

        self.workbench.work("penetration log", tr("Reading the log …"), log.read, done)


def _by(run: PenetrationRun | None, parameters: PenetrationParameters) -> bool:
    return run is not None and run.parameters == asdict(parameters)
