"""The gap page: choose a model and records, diagnose, see where, which and how far, act on it."""

from pathlib import Path

from PySide6.QtCore import QSignalBlocker, Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QBoxLayout,
    QHBoxLayout,
    QMenu,
    QPushButton,
    QStackedWidget,
    QTabBar,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from rotemina.app.motion.model_in_use import ModelInUse
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import Area, Panel
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.theme import Theme
from rotemina.app.shell.workbench import Level, Run, Workbench
from rotemina.app.widgets.controls import allow, plain_tip, set_property
from rotemina.app.widgets.labels import hint
from rotemina.app.widgets.scroll import scrolled
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.gap.actions import Actions
from rotemina.plugins.gap.advice import check_title, readiness
from rotemina.plugins.gap.answer import Answer
from rotemina.plugins.gap.axis_cells import AxisCells
from rotemina.plugins.gap.blind_page import BlindPage
from rotemina.plugins.gap.causes_view import CausesView
from rotemina.plugins.gap.diagnosing import Diagnosing
from rotemina.plugins.gap.distribution_view import DistributionView
from rotemina.plugins.gap.headline_view import HEIGHT, LITTLE, Headline
from rotemina.plugins.gap.hidden_machine import HiddenMachineTrial
from rotemina.plugins.gap.model_switch import ModelSwitch, against, candidate
from rotemina.plugins.gap.playing import Playing
from rotemina.plugins.gap.progress_view import ProgressView
from rotemina.plugins.gap.proof import Proof, new_motion, prove
from rotemina.plugins.gap.proof_view import ProofView
from rotemina.plugins.gap.records import Records
from rotemina.plugins.gap.shrinkage_view import ShrinkageView
from rotemina.plugins.gap.start_section import StartSection
from rotemina.plugins.gap.words import stage_name
from rotemina.sim.gap.suggestion import suggestion

VIEWS = (
    marked("gap", "Where"),
    marked("gap", "Which effect"),
    marked("gap", "How far"),
    marked("gap", "Unseen motion"),
)
WHERE, WHICH, FAR, PROOF, RUNNING, HINT = range(6)
TIPS = (
    marked("gap", "Axis, channel, frequencies and kind of motion in which the gap lies"),
    marked("gap", "Candidates with their probabilities, explanation and advice"),
    marked("gap", "How far the gap shrinks with the causes, down to the noise floor"),
    marked("gap", "How far it shrinks on a motion that the diagnosis has not seen"),
)
_HEIGHT = 240
_UPRIGHT_FROM = (1400, 420)  # px of width and height, from which the rail stands at the side
_WIDEST = 1400  # of the main column: longer lines read worse
_NOT_FORETOLD = marked("gap", "commands cannot predict any of the causes")
_NO_ANSWER = marked("gap", "there is no diagnosis yet; diagnose records first")


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
        self._usable: str | None = ""  # why not; None: it is
        self._resting = True
        self._goes_on = False  # to diagnose the records that are being read
        self._experiment: str | None = None  # that is asked for, or under way
        self._check: str | None = None
        self.diagnosing = Diagnosing(self)
        self.playing = Playing(workbench, self)
        self.actions_of = Actions(workbench, self)
        self.model_switch = ModelSwitch(workbench, self)
        self.hidden_trial = HiddenMachineTrial(workbench, self)
        self.records = Records(workbench, self)
        self.rail = StartSection(workbench, self.records)
        self.robots, self.start, self.stop = self.rail.robots, self.rail.start, self.rail.stop
        self.progress, self.doing = self.rail.progress, self.rail.doing
        self.blind: BlindPage | None = None
        self._make_buttons()
        self._make_views()
        self._lay_out()
        self._connect()
        self._show_state()

    # --- parts ------------------------------------------------------------------------------------

    def _make_buttons(self) -> None:
        self.use = QPushButton(translate("gap", "Use corrected model"))
        self.twin = QPushButton(translate("gap", "Add to twin …"))
        self.motion = QPushButton(translate("gap", "New motion …"))
        self.report = QPushButton(translate("gap", "Report …"))
        self.more = QToolButton()
        self.more.setText(translate("gap", "More"))
        self.more.setToolTip(
            translate("gap", "Save the diagnosis as JSON; test how often the diagnosis is correct")
        )
        self.more.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        menu = QMenu(self)
        self.save = menu.addAction(translate("gap", "Save JSON …"))
        self.test = menu.addAction(translate("gap", "Blind test …"))
        menu.addSeparator()
        self.hide_machine = menu.addAction(translate("gap", "Hidden machine …"))
        self.reveal = menu.addAction(translate("gap", "Reveal"))
        menu.aboutToShow.connect(self._offer_hidden)
        self.more.setMenu(menu)

    def _make_views(self) -> None:
        theme = self.workbench.theme
        self.distribution, self.causes, self.shrinkage = (
            DistributionView(theme),
            CausesView(theme),
            ShrinkageView(theme),
        )
        self.proof, self.running = ProofView(theme), ProgressView(theme)
        self.hint = hint(readiness(0))
        self.views = QStackedWidget()
        for view in (
            self.distribution,
            self.causes,
            self.shrinkage,
            self.proof,
            self.running,
            self.hint,
        ):
            self.views.addWidget(view)
        self.tabs = QTabBar()
        self.tabs.setAccessibleName(translate("gap", "View"))
        self.tabs.setExpanding(False)
        self.tabs.setDrawBase(False)
        for number, name in enumerate(VIEWS):
            self.tabs.addTab(translate("gap", name))
            self.tabs.setTabToolTip(number, translate("gap", TIPS[number]))
        self.headline = Headline([self.use], [self.twin, self.report, self.more])
        self.verdict = self.headline.sentence
        self.plan = QPushButton(translate("gap", "Play next experiment …"))
        self.plan.setToolTip(
            plain_tip(
                translate(
                    "gap",
                    "Play the motion that best distinguishes the candidates, and diagnose its "
                    "record with the others",
                )
            )
        )
        self.cells = AxisCells(theme)

    def _lay_out(self) -> None:
        head = QHBoxLayout()
        head.setSpacing(8)
        head.addWidget(self.tabs)
        head.addStretch(1)
        head.addWidget(self.plan)
        head.addWidget(self.motion)
        main = QWidget()
        main.setMaximumWidth(_WIDEST)
        column = QVBoxLayout(main)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(6)
        for widget in (self.headline, self.cells):
            column.addWidget(widget)
        column.addLayout(head)
        column.addWidget(self.views, 1)
        self.scroll = scrolled(main, sideways=True)
        self._outer = QBoxLayout(QBoxLayout.Direction.TopToBottom, self)
        self._outer.setContentsMargins(10, 6, 10, 6)
        self._outer.setSpacing(8)
        self._outer.addWidget(self.rail)
        self._outer.addWidget(self.scroll, 1)
        self.setMinimumHeight(_HEIGHT)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 (Qt's name)
        """Put the rail at the side where there is room, else above."""
        super().resizeEvent(event)
        width, height = _UPRIGHT_FROM
        upright = self.width() >= width and self.height() >= height
        self.rail.stand(upright=upright)
        way = QBoxLayout.Direction
        self._outer.setDirection(way.LeftToRight if upright else way.TopToBottom)
        self.headline.setMinimumHeight(HEIGHT if upright else LITTLE)

    def _connect(self) -> None:
        self.start.clicked.connect(self._start)
        self.stop.clicked.connect(self.end)
        self.use.clicked.connect(
            lambda: self.model_switch.ask(self._known, against(self._known, self.proof.proof))
        )
        self.twin.clicked.connect(lambda: self.actions_of.ask_twin(self._known, self._source))
        self.motion.clicked.connect(self.check)
        self.report.clicked.connect(lambda: self.actions_of.ask_report(self._known))
        self.save.triggered.connect(lambda: self.actions_of.ask_json(self._known))
        self.test.triggered.connect(self.show_blind_test)
        self.hide_machine.triggered.connect(lambda: self.hidden_trial.begin())
        self.reveal.triggered.connect(lambda: self.hidden_trial.reveal(self.answer))
        self.plan.clicked.connect(self.play_experiment)
        self.actions_of.twin_saved.connect(self.robots.load)
        self.robots.changed.connect(self.records.use_robot)
        self.records.changed.connect(self._show_state)
        self.records.complete.connect(self._go_on)
        self.tabs.currentChanged.connect(lambda _: self._show_state())
        self.cells.chosen.connect(lambda _: self._show_axis())
        self.diagnosing.progressed.connect(self._show_progress)
        self.diagnosing.stepped.connect(self.running.show_step)
        self.diagnosing.finished.connect(self.take_answer)
        self.diagnosing.failed.connect(self._fail)
        self.playing.played.connect(self._use_played)
        self.workbench.run_changed.connect(self._prove)
        self.workbench.refreshed.connect(self._follow_motion)
        self.workbench.closing.connect(self.diagnosing.close)
        self.workbench.theme_changed.connect(self._use_theme)

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
                translate("gap", "There are no records to diagnose: choose some."),
                about=self,
            )
            return
        names = [each.full for each in chosen]
        doing = (
            translate("gap", "waiting for the stopped work to end")
            if self.diagnosing.busy
            else stage_name("reading")
        )
        self.running.begin()
        self.diagnosing.start(self.robots.robot, names, [each.record for each in chosen])
        self._show_progress(doing, 0.0)
        self._show_state()

    def end(self) -> None:
        """Stop the diagnosis that runs."""
        self.diagnosing.stop()
        self.doing.setText(translate("gap", "The diagnosis was stopped."))
        self._show_state()

    def take_answer(self, answer: Answer) -> None:
        """Show a diagnosis."""
        self.answer, self._source = answer, self.robots.source
        self._candidate = candidate(answer)
        self.distribution.show_answer(answer)
        self.proof.show_proof(None)
        self.cells.show_answer(answer)
        self.headline.show_answer(answer, None)
        self.doing.setText("")
        self._show_state()

    def _fail(self, message: str) -> None:
        self.doing.setText(
            translate("gap", "The diagnosis failed; the notice above gives the reason.")
        )
        self.workbench.notify(Level.ERROR, message, about=self)
        self._show_state()

    # --- what is shown ----------------------------------------------------------------------------

    def _show_state(self) -> None:
        running, answer = self.diagnosing.running, self.answer
        chosen = len(self.records.chosen)
        self.start.setText(
            translate("gap", "Diagnose") if chosen else translate("gap", "Diagnose …")
        )
        tip_of_start = (
            translate("gap", "Find the effects that the model lacks")
            if chosen
            else translate("gap", "Choose records and diagnose them")
        )
        allow(
            self.start,
            translate("gap", "a diagnosis is running") if running else None,
            tip_of_start,
        )
        allow(
            self.stop,
            None if running else translate("gap", "nothing is running"),
            translate("gap", "Stop the diagnosis; motion continues"),
        )
        self.robots.setEnabled(not running)
        self.rail.menu.setEnabled(not running)
        self.rail.list.setEnabled(not running)
        self.progress.setVisible(running)
        why = translate("gap", _NO_ANSWER) if answer is None else None
        found = why or (
            None if answer and answer.diagnosis.fitted else translate("gap", "no effect was found")
        )
        self._usable = found or (None if self._candidate else translate("gap", _NOT_FORETOLD))
        self._show_use()
        allow(
            self.twin,
            found,
            translate("gap", "Write a robot file of the model with the causes found"),
        )
        allow(
            self.motion,
            found,
            translate("gap", "Play a motion that no record contains, and measure its gap"),
        )
        allow(
            self.report,
            why,
            translate("gap", "Write the report with all figures, and open it"),
        )
        self.save.setEnabled(why is None)
        done = answer is not None and not running
        self.plan.setVisible(done and bool(self._known.diagnosis.experiments))
        self.tabs.setVisible(done)
        for widget in (self.headline, self.cells, self.motion):
            widget.setVisible(done)
        self.doing.setVisible(not done)
        self.hint.setText(readiness(chosen))
        shown = self.tabs.currentIndex() if done else RUNNING if running else HINT
        self.views.setCurrentIndex(shown)

    def _show_use(self) -> None:
        """Offer the corrected model: by itself where it is better, else after a question."""
        answer, why_not = self.answer, self._usable
        doubt = against(answer, self.proof.proof) if answer and not why_not else None
        if why_not is None and not self._resting:
            why_not = translate("gap", "the machine is still moving")
        said = translate(
            "gap",
            "Predictions only: commands to the machine do not change. The panel "
            "Compensation changes them.",
        )
        self.use.setText(
            translate("gap", "Use anyway …") if doubt else translate("gap", "Use corrected model")
        )
        set_property(self.use, "primary", doubt is None)
        allow(self.use, why_not, "\n".join(filter(None, (doubt, said))))

    def _follow_motion(self, state: SessionState) -> None:
        """Offer the switch of the model at rest only."""
        resting = state.activity is DeviceState.IDLE and not state.queued
        if resting is not self._resting:
            self._resting = resting
            self._show_use()

    def _show_progress(self, doing: str, share: float) -> None:
        self.progress.setValue(round(1000 * share))
        text = translate("gap", "{share:.0f} % done")
        self.progress.setToolTip(text.format(share=100.0 * share))
        self.doing.setText(doing)

    def _show_axis(self) -> None:
        axis = self.cells.current
        if self.answer is not None and axis is not None:
            self.causes.show_axis(self.answer, axis)
            self.shrinkage.show_axis(self.answer, axis)

    def _use_theme(self, theme: Theme) -> None:
        for view in (
            self.distribution,
            self.causes,
            self.shrinkage,
            self.proof,
            self.running,
            self.cells,
        ):
            view.set_theme(theme)

    # --- what is played ---------------------------------------------------------------------------

    def play_experiment(self) -> None:
        """Ask whether to play the suggested experiment: of the axis in sight, or the first."""
        experiments = self._known.diagnosis.experiments
        axis = self.cells.current
        number = next((n for n, one in enumerate(experiments) if one.axis == axis), 0)
        made = suggestion(experiments[number], number + 1, "gap", self._known.units)
        self._experiment = made.names.commands
        trajectory = made.records[self._experiment]
        self.playing.ask(
            self.main_window, translate("gap", "Next experiment"), self._experiment, trajectory
        )

    def check(self) -> None:
        """Ask whether to play a motion of the diagnosed axes that no record holds."""
        answer = self._known
        axes = tuple(answer.diagnosis.axes)
        self._check = check_title(axes)
        name = self._check
        self.workbench.work(
            "gap motion",
            translate("gap", "Computing a motion …"),
            lambda: new_motion(answer.diagnosis, answer.records, axes),
            lambda motion: self.playing.ask(
                self.main_window, translate("gap", "New motion"), name, motion
            ),
        )

    def _use_played(self, run: Run) -> None:
        if run.name == self._experiment and self.answer is not None:
            self._experiment = None
            self.records.join(self.answer.names, self.answer.records, run)
            self.diagnose()

    def _prove(self, run: Run) -> None:
        """Work out how far the gap has shrunk on what was played or opened since the answer."""
        answer, model = self.answer, self._candidate
        if answer is None or model is None or run.name == self._experiment:
            return
        self.workbench.work(
            "gap proof",
            translate("gap", "Comparing with the twin …"),
            lambda: prove(answer.diagnosis, model, run, self.workbench.session.memory),
            lambda proof: self._take_proof(answer, proof),
        )

    def show_proof(self) -> None:
        """Show what a new motion says."""
        with QSignalBlocker(self.tabs):
            self.tabs.setCurrentIndex(PROOF)
        self._show_state()

    def _take_proof(self, answer: Answer, proof: Proof) -> None:
        if answer is not self.answer or not proof.shrunk:
            return
        self.proof.show_proof(proof)
        self.headline.show_answer(answer, proof)
        self._show_state()
        if proof.name == self._check:  # it was asked for here: this is what is awaited
            self._check = None
            self.show_proof()
            self.main_window.bring_up("gap")

    def _offer_hidden(self) -> None:
        """Offer a hidden machine in the simulator's place, or to reveal the one that is there."""
        simulated = self.workbench.session.service.effects is not None
        self.hide_machine.setEnabled(simulated and self.hidden_trial.secret is None)
        self.reveal.setEnabled(self.hidden_trial.secret is not None)

    # --- the test of the diagnosis itself ---------------------------------------------------------

    def show_blind_test(self) -> None:
        """Open the page of the blind test."""
        if self.blind is None:
            self.blind = BlindPage(self.workbench, self.robots, self)
            self.blind.setWindowFlag(Qt.WindowType.Window)
        self.blind.show()
        self.blind.raise_()
