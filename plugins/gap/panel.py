"""The gap page: choose a model and records, diagnose, see where, which and how far, act on it."""

from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QBoxLayout

from rotemina.app.motion.model_in_use import ModelInUse
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import Area, Panel, offer_in_palette
from rotemina.app.shell.language import marked
from rotemina.app.shell.workbench import Level, Run, Workbench
from rotemina.app.widgets.controls import allow
from rotemina.app.widgets.scroll_areas import scrolled
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.gap import mark, tr
from rotemina.plugins.gap.answer_exports import Actions
from rotemina.plugins.gap.blind_page import BlindPage
from rotemina.plugins.gap.diagnosing import Diagnosing
from rotemina.plugins.gap.diagnosis_answer import Answer
from rotemina.plugins.gap.headline_view import HEIGHT, LITTLE
from rotemina.plugins.gap.hidden_machine import HiddenMachineTrial
from rotemina.plugins.gap.model_switch import ModelSwitch, against, candidate
from rotemina.plugins.gap.records import Records
from rotemina.plugins.gap.result_section import ResultSection, unfound
from rotemina.plugins.gap.start_section import StartSection
from rotemina.plugins.gap.unseen_motion import UnseenMotion
from rotemina.plugins.gap.unseen_motion_reduction import Proof
from rotemina.plugins.gap.words import stage_name
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.trajectory.axis_limits import check_commands_of_model

_HEIGHT = 240
_UPRIGHT_FROM = (1400, 420)  # px of width and height, from which the rail stands at the side
_NOT_FORETOLD = mark("commands cannot predict any of the causes")


class GapPanel(Panel):
    """A diagnosis from the choice of records to a corrected model."""

    title = marked("panels", "Gap diagnosis")
    area = Area.BOTTOM
    order = 50
    help_page = "gap-diagnosis.md#in-the-window"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.answer: Answer | None = None
        self._source: str | Path | None = None  # of the robot that the answer is about
        self._candidate: ModelInUse | None = None  # what the answer leads to
        self._resting = True
        self._goes_on = False  # to diagnose the records that are being read
        self.diagnosing = Diagnosing(self)
        self.unseen = UnseenMotion(workbench, self)
        self.actions_of = Actions(workbench, self)
        self.model_switch = ModelSwitch(workbench, self)
        self.hidden_trial = HiddenMachineTrial(workbench, self)
        self.records = Records(workbench, self)
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

    # --- parts ------------------------------------------------------------------------------------

    def _lay_out(self) -> None:
        self._outer = QBoxLayout(QBoxLayout.Direction.TopToBottom, self)
        self._outer.setContentsMargins(10, 6, 10, 6)
        self._outer.setSpacing(8)
        self._outer.addWidget(self.rail)
        self._outer.addWidget(scrolled(self.result, sideways=True), 1)
        self.setMinimumHeight(_HEIGHT)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 (Qt's name)
        """Put the rail at the side where there is room, else above."""
        super().resizeEvent(event)
        width, height = _UPRIGHT_FROM
        upright = self.width() >= width and self.height() >= height
        self.rail.stand(upright=upright)
        way = QBoxLayout.Direction
        self._outer.setDirection(way.LeftToRight if upright else way.TopToBottom)
        self.result.headline.setMinimumHeight(HEIGHT if upright else LITTLE)

    def _connect(self) -> None:
        self.start.clicked.connect(self._start)
        self.stop.clicked.connect(self.end)
        result = self.result
        result.use.clicked.connect(
            lambda: self.model_switch.ask(self._known, against(self._known, result.proof.proof))
        )
        result.twin.clicked.connect(lambda: self.actions_of.ask_twin(self._known, self._source))
        result.motion.clicked.connect(self.check)
        result.report.clicked.connect(lambda: self.actions_of.ask_report(self._known))
        result.save.triggered.connect(lambda: self.actions_of.ask_json(self._known))
        result.test.triggered.connect(self.show_blind_test)
        result.hide_machine.triggered.connect(lambda: self.hidden_trial.begin())
        result.reveal.triggered.connect(lambda: self.hidden_trial.reveal(self.answer))
        result.menu.aboutToShow.connect(self._offer_hidden)
        result.plan.clicked.connect(self.play_experiment)
        result.tabs.currentChanged.connect(lambda _: self._show_state())
        self.actions_of.twin_saved.connect(self.robots.load)
        self.robots.changed.connect(self.records.use_robot)
        self.records.changed.connect(self._show_state)
        self.records.complete.connect(self._go_on)
        self.diagnosing.progressed.connect(self._show_progress)
        self.diagnosing.stepped.connect(result.running.show_step)
        self.diagnosing.finished.connect(self.take_answer)
        self.diagnosing.failed.connect(self._fail)
        self.unseen.experiment_played.connect(self._use_played)
        self.unseen.check_begun.connect(self.result.turn_to_proof)
        self.unseen.proved.connect(self._take_proof)
        self.workbench.run_changed.connect(self.unseen.prove)
        self.follow_frames(self._follow_motion)
        self.workbench.diagnosis_asked.connect(self._start_asked)
        self.workbench.closing.connect(self.diagnosing.close)
        self.workbench.theme_changed.connect(result.set_theme)

    @property
    def _known(self) -> Answer:
        assert self.answer is not None, "what needs an answer is not allowed without"
        return self.answer

    # --- the diagnosis ----------------------------------------------------------------------------

    def _start(self) -> None:
        """Diagnose; where no records are chosen, ask for them first."""
        if self.records.chosen:
            self.diagnose()
        else:
            self._goes_on = True
            self.rail.menu.ask()

    def _start_asked(self) -> None:
        if not self.diagnosing.running:
            self._start()

    def _go_on(self) -> None:
        goes_on, self._goes_on = self._goes_on, False
        if goes_on and self.records.chosen and not self.diagnosing.running:
            self.diagnose()

    def diagnose(self) -> None:
        """Diagnose the chosen records; what was answered before stays until there is another."""
        chosen = self.records.chosen
        if not chosen:
            self.workbench.notify(
                Level.WARNING,
                tr("There are no records to diagnose: choose some."),
                about=self,
                until=lambda _: bool(self.records.chosen),
            )
            return
        names = [each.full for each in chosen]
        try:
            for name, each in zip(names, chosen, strict=True):
                if each.record is not None:
                    remedy = message("gap", "choose its model under Model")
                    check_commands_of_model(self.robots.robot, each.record, name, remedy)
        except InputError as error:
            self.workbench.notify(Level.ERROR, str(error), about=error)
            return
        doing = (
            tr("waiting for the stopped work to end")
            if self.diagnosing.busy
            else stage_name("reading")
        )
        self.result.running.begin()
        self.diagnosing.start(self.robots.robot, names, [each.record for each in chosen])
        self._show_progress(doing, 0.0)
        self._show_state()

    def end(self) -> None:
        """Stop the diagnosis that runs."""
        self.diagnosing.stop()
        self.doing.setText(tr("The diagnosis was stopped."))
        self._show_state()

    def take_answer(self, answer: Answer) -> None:
        """Show a diagnosis."""
        self.workbench.settled.emit(self)
        self.answer, self._source = answer, self.robots.source
        self._candidate = candidate(answer)
        self.unseen.use_answer(answer, self._candidate)
        self.result.show_answer(answer)
        self.doing.setText("")
        self._show_state()

    def _fail(self, message: str) -> None:
        self.doing.setText(tr("The diagnosis failed; the notice above gives the reason."))
        self.workbench.notify(Level.ERROR, message, about=self, subject=self)
        self._show_state()

    # --- what is shown ----------------------------------------------------------------------------

    def _show_state(self) -> None:
        running, answer = self.diagnosing.running, self.answer
        chosen = len(self.records.chosen)
        self.start.setText(tr("Diagnose") if chosen else tr("Diagnose …"))
        tip_of_start = (
            tr("Find the effects that the model lacks")
            if chosen
            else tr("Choose records and diagnose them")
        )
        allow(self.start, tr("a diagnosis is running") if running else None, tip_of_start)
        allow(
            self.stop,
            None if running else tr("nothing is running"),
            tr("Stop the diagnosis; motion continues"),
        )
        self.robots.setEnabled(not running)
        self.rail.menu.setEnabled(not running)
        self.rail.list.setEnabled(not running)
        self.progress.setVisible(running)
        done = answer is not None and not running
        self.doing.setVisible(not done)
        self._show_use()
        self.result.show_state(answer, chosen, running=running)

    def _show_use(self) -> None:
        """Offer the corrected model: by itself where it is better, else after a question."""
        answer = self.answer
        why_not = unfound(answer) or (None if self._candidate else tr(_NOT_FORETOLD))
        doubt = against(answer, self.result.proof.proof) if answer and not why_not else None
        if why_not is None and not self._resting:
            why_not = tr("the machine is still moving")
        self.result.offer_use(why_not, doubt)

    def _follow_motion(self, state: SessionState) -> None:
        """Offer the switch of the model at rest only; let a machine that moves have the cores."""
        resting = state.activity is DeviceState.IDLE and not state.queued
        if not resting:
            self.diagnosing.stand_back()
        if resting is not self._resting:
            self._resting = resting
            self._show_use()

    def _show_progress(self, doing: str, share: float) -> None:
        self.progress.setValue(round(1000 * share))
        self.progress.setToolTip(tr("{share:.0f} % done").format(share=100.0 * share))
        self.doing.setText(doing)

    # --- what is played ---------------------------------------------------------------------------

    def play_experiment(self) -> None:
        """Ask whether to play the suggested experiment: of the axis in sight, or the first."""
        self.unseen.ask_experiment(self._known, self.result.cells.current, self.main_window)

    def check(self) -> None:
        """Ask whether to play a motion of the diagnosed axes that no record holds."""
        self.unseen.ask_check(self._known, self.main_window)

    def _use_played(self, run: Run) -> None:
        self.records.join(self._known.names, self._known.records, run)
        self.diagnose()

    def _take_proof(self, proof: Proof, asked: bool) -> None:
        self.result.show_proof(self._known, proof)
        self._show_state()
        self.result.mark_proof()
        if asked:  # this is what is awaited
            self.workbench.arrived.emit("gap", proof)

    def _offer_hidden(self) -> None:
        """Offer a hidden machine in the simulator's place, or to reveal the one that is there."""
        simulated = self.workbench.session.service.effects is not None
        secret = self.hidden_trial.secret
        why = None if simulated else tr("only the simulator can hide a machine")
        hidden = None if secret is None else tr("a machine is hidden already; reveal it first")
        allow(self.result.hide_machine, why or hidden, "")
        allow(self.result.reveal, None if secret is not None else tr("no machine is hidden"), "")

    # --- the test of the diagnosis itself ---------------------------------------------------------

    def show_blind_test(self) -> None:
        """Open the page of the blind test."""
        if self.blind is None:
            self.blind = BlindPage(self.workbench, self.robots, self)
            self.blind.setWindowFlag(Qt.WindowType.Window)
        self.blind.show()
        self.blind.raise_()
