"""Panel for the compensation of hysteresis: train, check and apply inverses, tune loops."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import Signal

from rotemina.app.language import marked, translate_message
from rotemina.app.motion.session import NamedInverse, check_inverse_fits
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import (
    Panel,
    PanelArea,
    offer_in_palette,
)
from rotemina.app.shell.records import (
    ask_file,
    ask_files,
    ask_save_path,
)
from rotemina.app.widgets.controls import TabNews, enable_unless
from rotemina.app.widgets.layout import lay_out_with_controls, make_tabs
from rotemina.app.widgets.style import Theme
from rotemina.app.workbench import BackgroundJob, Level, ReportProgress, Workbench
from rotemina.drivers.contract import DeviceState
from rotemina.plugins.compensation import mark, tr
from rotemina.plugins.compensation.controls import CompensationControls
from rotemina.plugins.compensation.gain_search import GainSearch
from rotemina.plugins.compensation.inverse_training import (
    ProgressListener,
    TrainedInverses,
    train_from_records,
    train_in_simulation,
)
from rotemina.plugins.compensation.machine_actions import CompensationActions
from rotemina.plugins.compensation.plot_views import CheckView, LiveView, ParetoFrontView
from rotemina.plugins.compensation.words import NO_FRONT, NO_INVERSE, describe_kind
from rotemina.sim.compensate import read_trained, write_trained
from rotemina.sim.records import read_record
from rotemina.sim.robot import Robot

RECORD_FILTER = mark("Records (*.csv *.txt *.dat *.gz);;All files (*)")
INVERSE_FILTER = mark("Inverses (*.json)")
TUNING_FILTER = mark("Tunings (*.toml)")
CHECK_TAB, LIVE_TAB, FRONT_TAB = range(3)
_MIN_CONTROLS_WIDTH_PX = 300
_TRAINING_SEED = 0


class CompensationPanel(Panel):
    """Panel with controls at the left, and the check, live and tuning views at the right."""

    title = marked("panels", "Compensation")
    area = PanelArea.BOTTOM
    order = 33
    help_page = "compensation.md#the-panel"
    _event_received = Signal(object)

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        theme = workbench.theme
        self.controls = CompensationControls(workbench.robot)
        self.check, self.live, self.front = (
            CheckView(theme),
            LiveView(theme),
            ParetoFrontView(theme),
        )
        self.actions_on_machine = CompensationActions(workbench, self.controls, self.live)
        self.search = GainSearch(workbench, self.controls, self.front)
        self.job = BackgroundJob(self)
        self.inverses: TrainedInverses | None = None
        self._source = ""
        self.tabs, self.views = make_tabs(
            tr("View"), {tr("Check"): self.check, tr("Live"): self.live, tr("Tuning"): self.front}
        )
        self.news = TabNews(self.tabs)
        lay_out_with_controls(self, self.controls, _MIN_CONTROLS_WIDTH_PX, self.tabs, self.views)
        self._connect()
        offer_in_palette(self.controls.switch, self.controls.apply, self.controls.trial)
        safe_buttons = (
            self.controls.save,
            self.controls.tune,
            self.controls.keep,
            self.controls.stop,
        )
        offer_in_palette(*safe_buttons, safe_while_hidden=True)
        self._change_axis()
        self.controls.show_progress("", None)

    def train_in_simulation(self) -> None:
        """Train with a motion of the simulated axis, with the current effects."""
        robot, axis = self._make_simulated_robot(), self.controls.chosen
        self._train(
            "simulator",
            lambda report: train_in_simulation(robot, robot.effects, axis, _TRAINING_SEED, report),
        )

    def train_from_record(self) -> None:
        """Train with the last record."""
        robot, axis, record = (
            self._make_simulated_robot(),
            self.controls.chosen,
            self.workbench.record,
        )
        if record is not None:
            records = [("last record", record)]
            self._train(
                records[0][0], lambda report: train_from_records(robot, axis, records, report)
            )

    def train_from_files(self, paths: list[Path]) -> None:
        """Train with records from files."""
        robot, axis = self._make_simulated_robot(), self.controls.chosen

        def work(report: ProgressListener) -> TrainedInverses:
            records = [(path.name, read_record(path, robot=robot)) for path in paths]
            return train_from_records(robot, axis, records, report)

        self._train(", ".join(path.name for path in paths), work)

    def open_file(self, path: Path) -> None:
        """Load inverses from a file."""
        robot = self.workbench.robot

        def work() -> TrainedInverses:
            trained, provenance = read_trained(path)
            model = trained.models[trained.recommended_kind]
            check_inverse_fits(robot, NamedInverse(model, provenance.robot, path.name))
            return TrainedInverses(trained, provenance, {})

        def on_read(inverses: TrainedInverses) -> None:
            self._source = path.name
            self._use_inverses(inverses)

        self.workbench.read_file("open inverse", path.name, work, on_read)

    def save_file(self, path: Path) -> None:
        """Write the inverses to a file."""
        inverses = self.inverses
        if inverses is None:
            return

        def on_saved() -> None:
            self._source = path.name

        self.workbench.write_file(
            "save inverse",
            path,
            lambda: write_trained(path, inverses.trained, inverses.provenance),
            on_saved,
        )

    def play_trial(self) -> None:
        """Play decaying oscillations. The error is shown next to the errors in other modes."""
        self.tabs.setCurrentIndex(LIVE_TAB)
        self.actions_on_machine.play_trial()

    def tune(self) -> None:
        """Search for gains, and draw the front of each generation."""
        inverses = self.inverses if self.controls.forward.isChecked() else None
        model = (
            None if inverses is None else inverses.trained.models[inverses.trained.recommended_kind]
        )
        self.tabs.setCurrentIndex(FRONT_TAB)
        self.search.tune(self._make_simulated_robot(), self.controls.chosen, model, self._source)

    def stop(self) -> None:
        """Stop the search, the training or the machine. The front found so far is kept."""
        if self.search.running:
            self.search.stop()
        elif self.job.running:
            self.job.stop()
            self.controls.show_progress(tr("Stopped; nothing was replaced."), None)
        else:
            self.workbench.stop()

    def _make_simulated_robot(self) -> Robot:
        robot, effects = self.workbench.robot, self.workbench.session.service.effects
        return robot if effects is None else replace(robot, effects=effects)

    def _train(self, source: str, work: Callable[[ProgressListener], TrainedInverses]) -> None:
        def train(report: ReportProgress) -> tuple[str, TrainedInverses]:
            return source, work(lambda message, share: report(message, share, None))

        self.controls.show_progress(tr("Training …"), 0.0)
        self.job.start(train)

    def _on_progress(self, message: str, share: float, _report: object) -> None:
        self.controls.show_progress(translate_message(message), share)

    def _on_finished(self, answer: tuple[str, TrainedInverses]) -> None:
        self.controls.show_progress("", None)
        self.workbench.settled.emit(self)
        self._source, inverses = answer
        self._use_inverses(inverses)

    def _on_failed(self, message: str) -> None:
        self.controls.show_progress(tr("Failed; nothing was replaced."), None)
        text = tr("Compensation: {message}")
        self.workbench.notify(Level.ERROR, text.format(message=message), about=self, subject=self)

    def _use_inverses(self, inverses: TrainedInverses) -> None:
        self.inverses = inverses
        kind_choice = self.controls.kind
        kind_choice.clear()
        for kind in inverses.trained.models:
            name = describe_kind(kind)
            if kind == inverses.trained.recommended_kind:
                name = tr("{inverse} (recommended)").format(inverse=name)
            kind_choice.addItem(name, kind)
        kind_choice.setCurrentIndex(kind_choice.findData(inverses.trained.recommended_kind))
        self.controls.axis.setCurrentIndex(self.controls.axis.findData(inverses.axis))
        self.check.show_inverses(inverses)
        self.news.mark(CHECK_TAB)

    def _refresh(self, state: SessionState) -> None:
        controls, axis = self.controls, self.controls.chosen
        no_axis = None if axis else tr("the robot has no piezo in open loop")
        running = self.job.running or self.search.running
        busy = tr("work is in progress; stop it or wait") if running else no_axis
        no_record = None if self.workbench.record is not None else tr("there is no record")
        nothing_to_save = None if self.inverses is not None else tr(NO_INVERSE)
        no_inverse_reason = self._find_inverse_objection(axis)
        no_point = None if self.search.tuning is not None else tr(NO_FRONT)
        self.actions_on_machine.refresh(state, no_inverse_reason)
        enable_unless(
            controls.simulate, busy, tr("Train with a motion of the simulated axis over its range")
        )
        enable_unless(controls.record, busy or no_record, tr("Train with the last record"))
        enable_unless(controls.files, busy, tr("Train with records that have cmd and meas or ref"))
        enable_unless(controls.open, busy, tr("Load inverses from a file"))
        enable_unless(controls.save, nothing_to_save, tr("Save these inverses to a file"))
        enable_unless(
            controls.tune, busy, tr("Search gains of a PID loop at 5 kHz on the simulated axis")
        )
        enable_unless(
            controls.forward,
            no_inverse_reason,
            tr("Feed the reference forward through the current inverse"),
        )
        enable_unless(controls.keep, busy or no_point, tr("Save the front with the selected point"))
        enable_unless(
            controls.open_gains, busy, tr("Load gains from a file that rotemina tune wrote")
        )
        can_stop = running or state.activity is DeviceState.PLAYING
        enable_unless(
            controls.stop, None if can_stop else tr("nothing is running"), tr("Stop the work")
        )

    def _find_inverse_objection(self, axis: str) -> str | None:
        if self.inverses is None:
            return tr(NO_INVERSE)
        trained_axis = self.inverses.axis
        if trained_axis == axis:
            return None
        return tr("the current inverse belongs to axis {axis}").format(axis=trained_axis)

    def _connect(self) -> None:
        controls = self.controls
        for button, action in (
            (controls.simulate, self.train_in_simulation),
            (controls.record, self.train_from_record),
            (controls.switch, lambda: self.actions_on_machine.switch(self.inverses, self._source)),
            (
                controls.apply,
                lambda: self.actions_on_machine.apply(self.search.tuning, self.search.name),
            ),
            (controls.sweep, self.actions_on_machine.sweep),
            (controls.trial, self.play_trial),
            (controls.tune, self.tune),
            (controls.stop, self.stop),
        ):
            button.clicked.connect(action)
        controls.axis.currentIndexChanged.connect(lambda _: self._change_axis())
        controls.files.clicked.connect(self._ask_records)
        controls.open.clicked.connect(self._ask_inverses)
        controls.save.clicked.connect(self._ask_save_inverses)
        controls.keep.clicked.connect(self._ask_save_gains)
        controls.open_gains.clicked.connect(self._ask_gains)
        self.job.progressed.connect(self._on_progress)
        self.job.finished.connect(self._on_finished)
        self.job.failed.connect(self._on_failed)
        self.search.failed.connect(self._on_failed)
        self._event_received.connect(self.actions_on_machine.on_event)
        self._unsubscribe = self.workbench.session.subscribe(self._event_received.emit)
        self.follow(self._refresh)
        self.workbench.theme_changed.connect(self._use_theme)
        self.workbench.closing.connect(self._close)

    def _ask_records(self) -> None:
        title, file_filter = tr("Records"), tr(RECORD_FILTER)
        ask_files(self, self.workbench, title, file_filter, self.train_from_files)

    def _ask_inverses(self) -> None:
        title, file_filter = tr("Inverses"), tr(INVERSE_FILTER)
        ask_file(self, self.workbench, title, file_filter, self.open_file)

    def _ask_save_inverses(self) -> None:
        title = tr("Save inverses")
        ask_save_path(
            self, self.workbench, title, tr(INVERSE_FILTER), "inverses.json", self.save_file
        )

    def _ask_gains(self) -> None:
        title, file_filter = tr("Gains"), tr(TUNING_FILTER)
        ask_file(self, self.workbench, title, file_filter, self.search.open)

    def _ask_save_gains(self) -> None:
        title, file_filter = tr("Save gains"), tr(TUNING_FILTER)
        ask_save_path(self, self.workbench, title, file_filter, "gains.toml", self.search.save)

    def _change_axis(self) -> None:
        self.actions_on_machine.forget_trials()
        axis = self.controls.chosen
        unit = (self.workbench.robot.unit(axis) if axis else None) or "m"
        self.live.set_unit(unit)
        if self.inverses is None:
            self.check.set_unit(unit)
        tuning = self.search.tuning
        if tuning is None:
            self.front.set_unit(unit)
        gains = tuning.chosen_point.gains if tuning is not None and tuning.axis == axis else None
        self.controls.typed.show_gains(axis, gains)

    def _use_theme(self, theme: Theme) -> None:
        for view in (self.check, self.live, self.front):
            view.set_theme(theme)

    def _close(self) -> None:
        self._unsubscribe()
        self.job.close()
        self.search.close()
