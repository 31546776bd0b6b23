"""The Gap diagnosis panel: choose a model and records, diagnose them, and use the result."""

from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QBoxLayout

from rotemina.app.language import marked
from rotemina.app.motion.model import ModelInUse
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import (
    Panel,
    PanelArea,
    offer_in_palette,
)
from rotemina.app.widgets.controls import enable_unless
from rotemina.app.widgets.layout import make_scroll_area
from rotemina.app.workbench import (
    ComparedRun,
    Level,
    Workbench,
)
from rotemina.drivers.contract import DeviceState
from rotemina.plugins.gap import mark, tr
from rotemina.plugins.gap.answer import (
    LARGE_HEIGHT_PX,
    SMALL_HEIGHT_PX,
    AnswerExports,
    DiagnosisAnswer,
    ModelSwitch,
    ResultSection,
    UnseenMotion,
    UnseenMotionResult,
    describe_worse_axes,
    explain_no_cause,
    find_candidate_model,
    stage_name,
)
from rotemina.plugins.gap.blind import BlindPage, HiddenMachineTrial
from rotemina.plugins.gap.diagnosing import BackgroundDiagnosis, RecordSelection, StartSection
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.trajectory import check_commands_fit_model

_MIN_HEIGHT_PX = 240

# If the page has at least this width and height, the rail is at its side, and otherwise above it.
_MIN_SIZE_FOR_SIDE_RAIL_PX = (1400, 420)
_NOT_PREDICTABLE = mark("commands cannot predict any of the causes")


class GapPanel(Panel):
    """Panel that leads from the choice of records through a diagnosis to a corrected model."""

    title = marked("panels", "Gap diagnosis")
    area = PanelArea.BOTTOM
    order = 50
    help_page = "gap-diagnosis.md#in-the-window"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.answer: DiagnosisAnswer | None = None
        # The name or file from which the robot of the answer was read; None for the robot in use.
        self._source: str | Path | None = None
        # The corrected model of the answer.
        self._candidate: ModelInUse | None = None
        self._is_at_rest = True
        # Whether a diagnosis starts as soon as the requested records are read.
        self._diagnose_when_read = False
        self.diagnosing = BackgroundDiagnosis(self)
        self.unseen = UnseenMotion(workbench, self)
        self.exports = AnswerExports(workbench, self)
        self.model_switch = ModelSwitch(workbench, self)
        self.hidden_trial = HiddenMachineTrial(workbench, self)
        self.records = RecordSelection(workbench, self)
        self.rail = StartSection(workbench, self.records)
        self.robots, self.start, self.stop = self.rail.robots, self.rail.start, self.rail.stop
        self.progress, self.doing = self.rail.progress, self.rail.doing
        self.blind: BlindPage | None = None
        self.result = ResultSection(workbench.theme)
        self._lay_out()
        self._connect()
        offer_in_palette(self.result.use, self.result.twin, self.result.plan, self.result.motion)
        offer_in_palette(self.start, self.stop, self.result.report, safe_while_hidden=True)
        self._show_state()

    def _lay_out(self) -> None:
        self._outer = QBoxLayout(QBoxLayout.Direction.TopToBottom, self)
        self._outer.setContentsMargins(10, 6, 10, 6)
        self._outer.setSpacing(8)
        self._outer.addWidget(self.rail)
        self._outer.addWidget(make_scroll_area(self.result, sideways=True), 1)
        self.setMinimumHeight(_MIN_HEIGHT_PX)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 (Qt's name)
        """Put the rail at the side of a large page, and above a small one."""
        super().resizeEvent(event)
        width, height = _MIN_SIZE_FOR_SIDE_RAIL_PX
        is_upright = self.width() >= width and self.height() >= height
        self.rail.set_upright(upright=is_upright)
        direction = QBoxLayout.Direction
        self._outer.setDirection(direction.LeftToRight if is_upright else direction.TopToBottom)
        self.result.headline.setMinimumHeight(LARGE_HEIGHT_PX if is_upright else SMALL_HEIGHT_PX)

    def _connect(self) -> None:
        self.start.clicked.connect(self._start)
        self.stop.clicked.connect(self.stop_diagnosis)
        result = self.result
        result.use.clicked.connect(
            lambda: self.model_switch.ask(
                self._current_answer,
                describe_worse_axes(self._current_answer, result.unseen_motion.latest),
            )
        )
        result.twin.clicked.connect(
            lambda: self.exports.ask_twin(self._current_answer, self._source)
        )
        result.motion.clicked.connect(self.play_new_motion)
        result.report.clicked.connect(lambda: self.exports.ask_report(self._current_answer))
        result.save.triggered.connect(lambda: self.exports.ask_json(self._current_answer))
        result.test.triggered.connect(self.show_blind_test)
        result.hide_machine.triggered.connect(lambda: self.hidden_trial.begin())
        result.reveal.triggered.connect(lambda: self.hidden_trial.reveal(self.answer))
        result.menu.aboutToShow.connect(self._update_hidden_actions)
        result.plan.clicked.connect(self.play_experiment)
        result.tabs.currentChanged.connect(lambda _: self._show_state())
        self.exports.twin_saved.connect(self.robots.load)
        self.robots.changed.connect(self.records.use_robot)
        self.records.changed.connect(self._show_state)
        self.records.reading_finished.connect(self._diagnose_after_reading)
        self.diagnosing.progressed.connect(self._show_progress)
        self.diagnosing.stepped.connect(result.running.show_step)
        self.diagnosing.finished.connect(self.take_answer)
        self.diagnosing.failed.connect(self._fail)
        self.unseen.experiment_played.connect(self._diagnose_with_run)
        self.unseen.check_started.connect(self.result.open_unseen_motion_tab)
        self.unseen.reduction_measured.connect(self._take_result)
        self.workbench.run_changed.connect(self.unseen.measure_reduction)
        self.follow_frames(self._follow_motion)
        self.workbench.diagnosis_asked.connect(self._start_if_idle)
        self.workbench.closing.connect(self.diagnosing.close)
        self.workbench.theme_changed.connect(result.set_theme)

    @property
    def _current_answer(self) -> DiagnosisAnswer:
        assert self.answer is not None, "actions that need an answer are disabled without one"
        return self.answer

    def _start(self) -> None:
        """Diagnose the chosen records; if there are none, ask for them first."""
        if self.records.chosen:
            self.diagnose()
        else:
            self._diagnose_when_read = True
            self.rail.menu.ask()

    def _start_if_idle(self) -> None:
        if not self.diagnosing.running:
            self._start()

    def _diagnose_after_reading(self) -> None:
        is_requested, self._diagnose_when_read = self._diagnose_when_read, False
        if is_requested and self.records.chosen and not self.diagnosing.running:
            self.diagnose()

    def diagnose(self) -> None:
        """Diagnose the chosen records. The last answer is kept until there is a new one."""
        chosen = self.records.chosen
        if not chosen:
            self.workbench.notify(
                Level.WARNING,
                tr("There are no records to diagnose: choose some."),
                about=self,
                until=lambda _: bool(self.records.chosen),
            )
            return
        names = [listed.full_name for listed in chosen]
        try:
            for name, listed in zip(names, chosen, strict=True):
                if listed.record is not None:
                    remedy = message("gap", "choose its model under Model")
                    check_commands_fit_model(self.robots.robot, listed.record, name, remedy)
        except InputError as error:
            self.workbench.notify(Level.ERROR, str(error), about=error)
            return
        step_text = (
            tr("waiting for the stopped work to end")
            if self.diagnosing.busy
            else stage_name("reading")
        )
        self.result.running.begin()
        self.diagnosing.start(self.robots.robot, names, [listed.record for listed in chosen])
        self._show_progress(step_text, 0.0)
        self._show_state()

    def stop_diagnosis(self) -> None:
        """Stop the running diagnosis."""
        self.diagnosing.stop()
        self.doing.setText(tr("The diagnosis was stopped."))
        self._show_state()

    def take_answer(self, answer: DiagnosisAnswer) -> None:
        """Show a diagnosis."""
        self.workbench.settled.emit(self)
        self.answer, self._source = answer, self.robots.source
        self._candidate = find_candidate_model(answer)
        self.unseen.use_answer(answer, self._candidate)
        self.result.show_answer(answer)
        self.doing.setText("")
        self._show_state()

    def _fail(self, message: str) -> None:
        self.doing.setText(tr("The diagnosis failed; the notice above gives the reason."))
        self.workbench.notify(Level.ERROR, message, about=self, subject=self)
        self._show_state()

    def _show_state(self) -> None:
        is_running, answer = self.diagnosing.running, self.answer
        chosen_count = len(self.records.chosen)
        self.start.setText(tr("Diagnose") if chosen_count else tr("Diagnose …"))
        start_tooltip = (
            tr("Find the effects that the model lacks")
            if chosen_count
            else tr("Choose records and diagnose them")
        )
        enable_unless(
            self.start, tr("a diagnosis is running") if is_running else None, start_tooltip
        )
        enable_unless(
            self.stop,
            None if is_running else tr("nothing is running"),
            tr("Stop the diagnosis; motion continues"),
        )
        self.robots.setEnabled(not is_running)
        self.rail.menu.setEnabled(not is_running)
        self.rail.list.setEnabled(not is_running)
        self.progress.setVisible(is_running)
        has_result = answer is not None and not is_running
        self.doing.setVisible(not has_result)
        self._offer_model()
        self.result.show_state(answer, chosen_count, running=is_running)

    def _offer_model(self) -> None:
        """Offer the corrected model, but only after a confirmation if there is an objection."""
        answer = self.answer
        unavailable_reason = explain_no_cause(answer) or (
            None if self._candidate else tr(_NOT_PREDICTABLE)
        )
        objection = (
            describe_worse_axes(answer, self.result.unseen_motion.latest)
            if answer and not unavailable_reason
            else None
        )
        if unavailable_reason is None and not self._is_at_rest:
            unavailable_reason = tr("the machine is still moving")
        self.result.offer_use(unavailable_reason, objection)

    def _follow_motion(self, state: SessionState) -> None:
        """Offer the corrected model only at rest. During motion, lower the diagnosis's priority."""
        is_at_rest = state.activity is DeviceState.IDLE and not state.queued
        if not is_at_rest:
            self.diagnosing.lower_priority()
        if is_at_rest is not self._is_at_rest:
            self._is_at_rest = is_at_rest
            self._offer_model()

    def _show_progress(self, step_text: str, fraction: float) -> None:
        self.progress.setValue(round(1000 * fraction))
        self.progress.setToolTip(tr("{share:.0f} % done").format(share=100.0 * fraction))
        self.doing.setText(step_text)

    def play_experiment(self) -> None:
        """Ask whether to play the suggested experiment of the chosen axis, else the first one."""
        self.unseen.ask_experiment(
            self._current_answer, self.result.cells.current, self.main_window
        )

    def play_new_motion(self) -> None:
        """Ask whether to play a motion of the diagnosed axes that no record contains."""
        self.unseen.ask_check(self._current_answer, self.main_window)

    def _diagnose_with_run(self, run: ComparedRun) -> None:
        self.records.tick_with_run(self._current_answer.names, self._current_answer.records, run)
        self.diagnose()

    def _take_result(self, proof: UnseenMotionResult, is_requested: bool) -> None:
        self.result.show_unseen_motion(self._current_answer, proof)
        self._show_state()
        self.result.mark_unseen_motion_tab()
        # The operator is waiting for the result of a motion that was requested here.
        if is_requested:
            self.workbench.arrived.emit("gap", proof)

    def _update_hidden_actions(self) -> None:
        is_simulated = self.workbench.session.service.effects is not None
        hidden_effects = self.hidden_trial.hidden_effects
        not_simulated_reason = None if is_simulated else tr("only the simulator can hide a machine")
        already_hidden_reason = (
            None if hidden_effects is None else tr("a machine is hidden already; reveal it first")
        )
        enable_unless(self.result.hide_machine, not_simulated_reason or already_hidden_reason, "")
        enable_unless(
            self.result.reveal,
            None if hidden_effects is not None else tr("no machine is hidden"),
            "",
        )

    def show_blind_test(self) -> None:
        """Open the dialog of the blind test."""
        if self.blind is None:
            self.blind = BlindPage(self.workbench, self.robots, self)
            self.blind.setWindowFlag(Qt.WindowType.Window)
        self.blind.show()
        self.blind.raise_()
