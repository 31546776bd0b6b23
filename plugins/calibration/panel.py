"""Panel for sensor calibration: the guided procedure, its result, and stored calibrations."""

from collections.abc import Callable
from datetime import datetime
from pathlib import Path

from rotemina.app.calibration import (
    CalibrationPlayback,
    CalibrationPlaybackPhase,
    CalibrationPlaybackState,
    SourceRecord,
    StoredCalibration,
    make_calibration_file,
    make_source_record,
)
from rotemina.app.language import marked, translate_message
from rotemina.app.motion.device import OPERATOR
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import (
    Panel,
    PanelArea,
    offer_in_palette,
)
from rotemina.app.shell.records import ask_files
from rotemina.app.widgets.controls import TabNews
from rotemina.app.widgets.layout import lay_out_with_controls, make_tabs
from rotemina.app.widgets.style import Theme
from rotemina.app.workbench import Level, WaitingRequest, Workbench
from rotemina.plugins.calibration import mark, tr
from rotemina.plugins.calibration.procedure_controls import CalibrationControls
from rotemina.plugins.calibration.result_view import CalibrationResultView
from rotemina.plugins.calibration.stored_view import StoredCalibrationsView
from rotemina.plugins.calibration.words import NO_PLAN_TEXT, describe_motion, make_motion_curves
from rotemina.sim.calibration import (
    SensorCalibration,
    calibrate_sensor,
    compare_with_laser,
    make_calibration_motion,
)
from rotemina.sim.records import Record, read_record
from rotemina.sim.trajectory import CheckedTrajectory, dry_run

NOT_RUN_TEXT = mark("Not run: {why}. Press Run again.")
RECORD_FILTER = mark("Records (*.csv *.txt *.dat *.gz);;All files (*)")
_RESULT_TAB, _ISO_TAB, _STORED_TAB = range(3)
_PROCEDURE_WIDTH_PX = 276


class CalibrationPanel(Panel):
    """Panel with the procedure next to its result and the stored calibrations."""

    title = marked("panels", "Sensor calibration")
    area = PanelArea.BOTTOM
    order = 32
    help_page = "calibration.md#for-operators-the-panel-sensor-calibration"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.procedure = CalibrationControls(workbench.robot)
        self.result = CalibrationResultView(workbench.theme)
        self.stored = StoredCalibrationsView()
        self.calibration: SensorCalibration | None = None
        self._sources: tuple[SourceRecord, ...] = ()
        self._motion: CheckedTrajectory | None = None
        self._plan_text = ""
        self._run: CalibrationPlayback | None = None
        self.tabs, self.views = make_tabs(
            tr("View"),
            {tr("Result"): self.result, "ISO 230-2": self.result.iso, tr("Stored"): self.stored},
        )
        self.news = TabNews(self.tabs)
        self.tabs.setTabEnabled(_ISO_TAB, False)
        lay_out_with_controls(self, self.procedure, _PROCEDURE_WIDTH_PX, self.tabs, self.views)
        self._connect()
        offer_in_palette(
            self.procedure.run,
            self.result.store,
            self.stored.use_button,
            self.stored.switch_off_button,
        )
        offer_in_palette(
            self.procedure.plan, self.procedure.fit, self.procedure.stop, safe_while_hidden=True
        )
        self._refresh_stored()

    def plan(self) -> None:
        """Compute the motion and check it by a dry run, in the background."""
        axis, runs = self.procedure.chosen_axis, self.procedure.runs.value()
        targets, robot = self.procedure.targets.value(), self.workbench.robot
        period_s = self.workbench.session.setpoint_period_s

        def work() -> CheckedTrajectory:
            motion = make_calibration_motion(robot, axis, runs=runs, targets=targets)
            return dry_run(robot, motion, setpoint_period_s=period_s).require()

        self.workbench.work("calibration plan", tr("Planning …"), work, self._show_plan)

    def start(self) -> None:
        """Play the planned motion, and record sensor and laser."""
        if self._run is not None or self._motion is None:
            reason = tr("there is no plan yet") if self._run is None else tr("a run is in progress")
            WaitingRequest(self.workbench, tr(NOT_RUN_TEXT)).withdraw(reason)
            return
        run = CalibrationPlayback(self.workbench.session, self.procedure.chosen_axis, self._motion)
        self._run = run

        def reset_run() -> None:
            run.close()
            if self._run is run:
                self._run = None
                self.procedure.status_label.setText(self._plan_text)

        request = WaitingRequest(self.workbench, tr(NOT_RUN_TEXT), on_refused=reset_run)
        self.workbench.at_rest.do(request, lambda: run.start(permit=request.permit))
        self.update_now()

    def stop(self) -> None:
        """Stop the machine and discard the run."""
        if self._run is not None:
            self._run.stop(by=OPERATOR)

    def fit_record(self, name: str, record: Record) -> None:
        """Fit the calibration to one record, in the background."""
        self._fit_records(lambda: [(name, record)])

    def fit_files(self, paths: list[Path]) -> None:
        """Fit the calibration to records from files, in the background."""
        robot = self.workbench.robot
        self._fit_records(lambda: [(path.name, read_record(path, robot=robot)) for path in paths])

    def store(self) -> None:
        """Store the result, and use it from now on."""
        calibration, sources = self.calibration, self._sources
        if calibration is None:
            return
        store, robot = self.workbench.operation.calibrations, self.workbench.robot

        def work() -> Path:
            file = make_calibration_file(
                calibration, robot.name, sources, datetime.now().astimezone()
            )
            path = store.save(file)
            store.select(file.axis, path)
            return path

        def show_path(path: Path) -> None:
            self.result.show_stored()
            text = tr("Calibration of {axis} in use: {path}")
            self.workbench.notify(Level.GOOD, text.format(axis=calibration.axis, path=path))
            self._refresh_stored()

        self.workbench.work("store calibration", tr("Storing the calibration …"), work, show_path)

    def switch(self, axis: str, path: Path | None) -> None:
        """Use the stored calibration at ``path`` for an axis, or no calibration if it is None."""
        store = self.workbench.operation.calibrations
        self.workbench.work(
            "switch calibration",
            tr("Switching the calibration …"),
            lambda: store.select(axis, path),
            lambda _: self._refresh_stored(),
        )

    def _forget_plan(self) -> None:
        self._motion = None
        self.procedure.status_label.setText(tr(NO_PLAN_TEXT))
        self.procedure.progress.setValue(0)

    def _show_plan(self, motion: CheckedTrajectory) -> None:
        axis = motion.commands.axes[0]
        if axis != self.procedure.chosen_axis:
            return
        self._motion = motion
        self._plan_text = describe_motion(motion.commands, axis, self.workbench.robot)
        self.procedure.status_label.setText(self._plan_text)
        self.calibration = None
        self.result.show_result(None)
        self.tabs.setTabEnabled(_ISO_TAB, False)
        self.result.show_curves(make_motion_curves(motion.commands, axis))
        self.news.mark(_RESULT_TAB)
        self.update_now()

    def _refresh(self, session: SessionState) -> None:
        run = self._run
        state = run.state if run is not None else CalibrationPlaybackState()
        # A run that waits for the machine to come to rest is shown as running.
        if run is not None and state.phase is CalibrationPlaybackPhase.IDLE:
            state = CalibrationPlaybackState(CalibrationPlaybackPhase.MOVING)
        motion = self._motion.commands if self._motion is not None else None
        if run is not None and motion is not None:
            waiting_text = (
                self.workbench.at_rest.waiting_text
                if run.state.phase is CalibrationPlaybackPhase.IDLE
                else ""
            )
            self.procedure.show_run(state, motion.duration_s, waiting_text)
        self.procedure.refresh(session, motion, state)
        if run is None or state.phase is CalibrationPlaybackPhase.MOVING:
            return
        self._run = None
        if run.record is not None:
            self.workbench.settled.emit(self)
            self.fit_record(f"calibration of {self.procedure.chosen_axis}", run.record)
        elif state.phase is CalibrationPlaybackPhase.FAILED:
            text = tr("Calibration: {message}.")
            self.workbench.notify(
                Level.ERROR,
                text.format(message=translate_message(state.message)),
                about=self,
                subject=self,
            )

    def _fit_records(self, load_records: Callable[[], list[tuple[str, Record]]]) -> None:
        axis, robot = self.procedure.chosen_axis, self.workbench.robot
        absolute = self.procedure.absolute.isChecked()

        def work() -> tuple[SensorCalibration, tuple[SourceRecord, ...]]:
            named_records = load_records()
            calibration = calibrate_sensor(
                robot,
                [compare_with_laser(record, axis, robot, name) for name, record in named_records],
                absolute=absolute,
            )
            return calibration, tuple(
                make_source_record(record, name) for name, record in named_records
            )

        self.workbench.work("calibration fit", tr("Fitting the sensor …"), work, self._show_result)

    def _show_result(self, answer: tuple[SensorCalibration, tuple[SourceRecord, ...]]) -> None:
        self.calibration, self._sources = answer
        self.result.show_result(self.calibration)
        self.tabs.setTabEnabled(_ISO_TAB, self.result.iso.rowCount() > 0)
        self.news.mark(_RESULT_TAB)

    def _refresh_stored(self) -> None:
        """Read and show the stored calibrations, and apply those in use to the session."""
        store, session = self.workbench.operation.calibrations, self.workbench.session

        def work() -> tuple[tuple[StoredCalibration, ...], tuple[str, ...]]:
            store.apply(session.corrections)
            return store.list_calibrations()

        def show_answer(answer: tuple[tuple[StoredCalibration, ...], tuple[str, ...]]) -> None:
            calibrations, problems = answer
            self.stored.show_stored(calibrations)
            text = tr("Stored")
            if calibrations:
                text = tr("Stored ({n})").format(n=len(calibrations))
            self.tabs.setTabText(_STORED_TAB, text)
            for problem in problems:
                self.workbench.notify(Level.WARNING, problem, about=self)

        activity = tr("Reading calibrations …")
        self.workbench.work("stored calibrations", activity, work, show_answer, renews=True)

    def _ask_records(self) -> None:
        title = tr("Records with sensor and laser")
        ask_files(self, self.workbench, title, tr(RECORD_FILTER), self.fit_files)

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
