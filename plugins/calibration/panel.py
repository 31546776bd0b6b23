"""Sensor calibration: the guided procedure, its result, and stored calibrations."""

from collections.abc import Callable
from datetime import datetime
from pathlib import Path

from rotemina.app.calibration.calibration_playback import CalibrationRun, Phase, RunState
from rotemina.app.calibration.files import Source, kept, source_of
from rotemina.app.calibration.store import Stored
from rotemina.app.motion.ownership import OPERATOR
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import Area, Panel, offer_in_palette
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.file_dialog import ask_files
from rotemina.app.shell.language import marked
from rotemina.app.shell.requests_at_rest import WaitingRequest
from rotemina.app.shell.theme import Theme
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.scroll_areas import lay_beside, tabbed
from rotemina.app.widgets.tab_dots import TabNews
from rotemina.plugins.calibration import mark, tr
from rotemina.plugins.calibration.procedure_controls import Procedure
from rotemina.plugins.calibration.result_view import ResultView
from rotemina.plugins.calibration.stored_view import StoredView
from rotemina.plugins.calibration.words import NOTHING, motion_drawing, planned
from rotemina.sim.calibration.comparable_parts import compared
from rotemina.sim.calibration.plan import calibration_motion
from rotemina.sim.calibration.sensor_calibration import Calibration, calibrated
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record
from rotemina.sim.trajectory.checked_trajectory import CheckedTrajectory
from rotemina.sim.trajectory.dry_run import dry_run

NOT_RUN = mark("Not run: {why}. Press Run again.")
RECORDS = mark("Records (*.csv *.txt *.dat *.gz);;All files (*)")
_RESULT, _ISO, _STORED = range(3)  # tabs
_WIDTH = 276  # of the procedure at least, px


class CalibrationPanel(Panel):
    """The procedure beside its result and the stored calibrations."""

    title = marked("panels", "Sensor calibration")
    area = Area.BOTTOM
    order = 32
    help_page = "calibration.md#for-operators-the-panel-sensor-calibration"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.procedure = Procedure(workbench.robot)
        self.result = ResultView(workbench.theme)
        self.stored = StoredView()
        self.calibration: Calibration | None = None
        self._sources: tuple[Source, ...] = ()
        self._motion: CheckedTrajectory | None = None
        self._plan_text = ""
        self._run: CalibrationRun | None = None
        self.tabs, self.views = tabbed(
            tr("View"),
            {tr("Result"): self.result, "ISO 230-2": self.result.iso, tr("Stored"): self.stored},
        )
        self.news = TabNews(self.tabs)
        self.tabs.setTabEnabled(_ISO, False)
        lay_beside(self, self.procedure, _WIDTH, self.tabs, self.views)
        self._connect()
        offer_in_palette(self.procedure.run, self.result.store, self.stored.on, self.stored.off)
        offer_in_palette(
            self.procedure.plan, self.procedure.fit, self.procedure.stop, safe_while_hidden=True
        )
        self._look()

    # --- plan and run -----------------------------------------------------------------------------

    def plan(self) -> None:
        """Make the motion and check it, in the background."""
        axis, runs = self.procedure.chosen, self.procedure.runs.value()
        targets, robot = self.procedure.targets.value(), self.workbench.robot
        period_s = self.workbench.session.setpoint_period_s

        def work() -> CheckedTrajectory:
            motion = calibration_motion(robot, axis, runs=runs, targets=targets)
            return dry_run(robot, motion, setpoint_period_s=period_s).require()

        self.workbench.work("calibration plan", tr("Planning …"), work, self._take_plan)

    def start(self) -> None:
        """Play the planned motion; sensor and laser are recorded."""
        if self._run is not None or self._motion is None:
            why = tr("there is no plan yet") if self._run is None else tr("a run is in progress")
            WaitingRequest(self.workbench, tr(NOT_RUN)).withdraw(why)
            return
        run = CalibrationRun(self.workbench.session, self.procedure.chosen, self._motion)
        self._run = run

        def refused() -> None:
            run.close()
            if self._run is run:
                self._run = None
                self.procedure.told.setText(self._plan_text)

        request = WaitingRequest(self.workbench, tr(NOT_RUN), undone=refused)
        self.workbench.at_rest.do(request, lambda: run.start(permit=request.permit))
        self.look_now()

    def stop(self) -> None:
        """Stop the machine; nothing of the run is kept."""
        if self._run is not None:
            self._run.stop(by=OPERATOR)

    # --- fit and store ----------------------------------------------------------------------------

    def fit_record(self, name: str, record: Record) -> None:
        """Calibrate by one record, in the background."""
        self._fit(lambda: [(name, record)])

    def fit_files(self, paths: list[Path]) -> None:
        """Calibrate by records of files."""
        robot = self.workbench.robot
        self._fit(lambda: [(path.name, read_record(path, robot=robot)) for path in paths])

    def store(self) -> None:
        """Keep the result, and use it from now on."""
        calibration, sources = self.calibration, self._sources
        if calibration is None:
            return
        store, robot = self.workbench.operation.calibrations, self.workbench.robot

        def work() -> Path:
            file = kept(calibration, robot.name, sources, datetime.now().astimezone())
            path = store.save(file)
            store.switch(file.axis, path)
            return path

        def done(path: Path) -> None:
            self.result.done_storing()
            text = tr("Calibration of {axis} in use: {path}")
            self.workbench.notify(Level.GOOD, text.format(axis=calibration.axis, path=path))
            self._look()

        self.workbench.work("store calibration", tr("Storing the calibration …"), work, done)

    def switch(self, axis: str, path: Path | None) -> None:
        """Use a stored calibration of an axis, or none."""
        store = self.workbench.operation.calibrations
        self.workbench.work(
            "switch calibration",
            tr("Switching the calibration …"),
            lambda: store.switch(axis, path),
            lambda _: self._look(),
        )

    # --- inside -----------------------------------------------------------------------------------

    def _forget_plan(self) -> None:
        self._motion = None
        self.procedure.told.setText(tr(NOTHING))
        self.procedure.progress.setValue(0)

    def _take_plan(self, motion: CheckedTrajectory) -> None:
        axis = motion.commands.axes[0]
        if axis != self.procedure.chosen:
            return
        self._motion = motion
        self._plan_text = planned(motion.commands, axis, self.workbench.robot)
        self.procedure.told.setText(self._plan_text)
        self.calibration = None
        self.result.show_result(None)
        self.tabs.setTabEnabled(_ISO, False)
        self.result.show_drawing(motion_drawing(motion.commands, axis))
        self.news.mark(_RESULT)
        self.look_now()

    def _refresh(self, session: SessionState) -> None:
        run = self._run
        state = run.state if run is not None else RunState()
        if run is not None and state.phase is Phase.IDLE:  # until the machine rests
            state = RunState(Phase.MOVING)
        motion = self._motion.commands if self._motion is not None else None
        if run is not None and motion is not None:
            waits = self.workbench.at_rest.words if run.state.phase is Phase.IDLE else ""
            self.procedure.show_run(state, motion.duration_s, waits)
        self.procedure.refresh(session, motion, state)
        if run is None or state.phase is Phase.MOVING:
            return
        self._run = None
        if run.record is not None:
            self.workbench.settled.emit(self)
            self.fit_record(f"calibration of {self.procedure.chosen}", run.record)
        elif state.phase is Phase.FAILED:
            text = tr("Calibration: {message}.")
            self.workbench.notify(
                Level.ERROR, text.format(message=spoken(state.message)), about=self, subject=self
            )

    def _fit(self, records: Callable[[], list[tuple[str, Record]]]) -> None:
        axis, robot = self.procedure.chosen, self.workbench.robot
        absolute = self.procedure.absolute.isChecked()

        def work() -> tuple[Calibration, tuple[Source, ...]]:
            read = records()
            found = calibrated(
                robot,
                [compared(record, axis, robot, name) for name, record in read],
                absolute=absolute,
            )
            return found, tuple(source_of(record, name) for name, record in read)

        self.workbench.work("calibration fit", tr("Fitting the sensor …"), work, self._take_result)

    def _take_result(self, answer: tuple[Calibration, tuple[Source, ...]]) -> None:
        self.calibration, self._sources = answer
        self.result.show_result(self.calibration)
        self.tabs.setTabEnabled(_ISO, self.result.iso.rowCount() > 0)
        self.news.mark(_RESULT)

    def _look(self) -> None:
        """Read what is stored, let the session use what is on, and show both."""
        store, session = self.workbench.operation.calibrations, self.workbench.session

        def work() -> tuple[tuple[Stored, ...], tuple[str, ...]]:
            store.apply(session.corrections)
            return store.listed()

        def done(answer: tuple[tuple[Stored, ...], tuple[str, ...]]) -> None:
            self.stored.show_stored(answer[0])
            text = tr("Stored")
            if answer[0]:
                text = tr("Stored ({n})").format(n=len(answer[0]))
            self.tabs.setTabText(_STORED, text)
            for problem in answer[1]:
                self.workbench.notify(Level.WARNING, problem, about=self)

        doing = tr("Reading calibrations …")
        self.workbench.work("stored calibrations", doing, work, done, renews=True)

    def _ask_records(self) -> None:
        title = tr("Records with sensor and laser")
        ask_files(self, self.workbench, title, tr(RECORDS), self.fit_files)

    def _close_run(self) -> None:
        if self._run is not None:
            self._run.close()

    def _use_theme(self, theme: Theme) -> None:
        self.result.set_theme(theme)

    def _connect(self) -> None:
        self.procedure.changed.connect(self._forget_plan)
        self.procedure.plan.clicked.connect(self.plan)
        self.procedure.run.clicked.connect(self.start)
        self.procedure.stop.clicked.connect(self.stop)
        self.procedure.fit.clicked.connect(self._ask_records)
        self.result.stored.connect(self.store)
        self.stored.switched.connect(self.switch)
        self.follow(self._refresh)
        self.workbench.theme_changed.connect(self._use_theme)
        self.workbench.closing.connect(self._close_run)
