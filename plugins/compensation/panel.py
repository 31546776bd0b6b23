"""Compensation of hysteresis: learn, check, put on, tune."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from threading import Event as Flag
from typing import Any

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtWidgets import (
    QDockWidget,
    QFileDialog,
    QFrame,
    QHBoxLayout,
    QPushButton,
    QScrollArea,
    QStackedWidget,
    QTabBar,
    QVBoxLayout,
)

from rotemina.app.motion.compensation import NamedInverse, check_belongs
from rotemina.app.motion.state import Event, PlaybackFinished, SessionState
from rotemina.app.panel import Area, Panel
from rotemina.app.shell.controls import allow
from rotemina.app.shell.theme import Theme
from rotemina.app.shell.workbench import Level, Run, Workbench
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.compensation.controls import Controls
from rotemina.app.shell.job import Job, Tell
from rotemina.plugins.compensation.learning import (
    Learned,
    Listener,
    learned_from,
    learned_simulated,
)
from rotemina.plugins.compensation.trial import NAME, Trial, trial_motion, trial_of
from rotemina.plugins.compensation.tuning import problem_of, search
from rotemina.plugins.compensation.views import CheckView, FrontView, LiveView
from rotemina.plugins.compensation.words import NOTHING, beyond, left, point_text
from rotemina.sim.compensate.file import read_trained, write_trained
from rotemina.sim.compensate.judgement import NAMES
from rotemina.sim.records.reading import read_record
from rotemina.sim.robot.model import Robot
from rotemina.sim.tuning.problem import Try
from rotemina.sim.tuning.result import Tuning, save_tuning
from rotemina.sim.tuning.search import Generation, SearchSettings

RECORDS = "Records (*.csv *.txt *.dat *.gz);;All files (*)"
INVERSES, TUNINGS = "Inverses (*.json)", "Tunings (*.toml)"
CHECK, LIVE, FRONT = range(3)  # tabs
_WIDTH = 300  # of the controls, px
_SEED = 0


class CompensationPanel(Panel):
    """Controls beside the judgement, the live loops and the search of gains."""

    title = "Compensation"
    area = Area.BOTTOM
    order = 33
    help_page = "compensation.md#the-panel"
    _happened = Signal(object)

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        theme = workbench.theme
        self.controls = Controls(workbench.robot)
        self.check, self.live, self.front = CheckView(theme), LiveView(theme), FrontView(theme)
        self.job, self._trying = Job(self), Job(self)
        self.learned: Learned | None = None
        self.tuning: Tuning | None = None
        self.trials: dict[bool, Trial] = {}
        self._source = ""
        self._problem: Any = None  # of the tuning in hand
        self._enough = Flag()
        self._searching = False
        self.views, self.tabs = QStackedWidget(), QTabBar()
        self.tabs.setAccessibleName("What is shown")
        self.tabs.setExpanding(False)
        self.tabs.setDrawBase(False)
        for view, name in ((self.check, "Check"), (self.live, "Live"), (self.front, "Tuning")):
            self.views.addWidget(view)
            self.tabs.addTab(name)
        self._lay_out()
        self._connect()
        self.controls.tell("", None)

    # --- learn ------------------------------------------------------------------------------------

    def learn_simulated(self) -> None:
        """Move the simulated axis with the machine's effects, and learn from that."""
        robot, axis = self._robot(), self.controls.chosen
        self._learn(
            "simulator",
            lambda tell: learned_simulated(robot, robot.effects, axis, _SEED, tell),
        )

    def learn_record(self) -> None:
        """Learn from the record in hand."""
        robot, axis, record = self._robot(), self.controls.chosen, self.workbench.record
        if record is not None:
            named = [("last record", record)]
            self._learn(named[0][0], lambda tell: learned_from(robot, axis, named, tell))

    def learn_files(self, paths: list[Path]) -> None:
        """Learn from records of files."""
        robot, axis = self._robot(), self.controls.chosen

        def work(tell: Listener) -> Learned:
            records = [(path.name, read_record(path, robot=robot)) for path in paths]
            return learned_from(robot, axis, records, tell)

        self._learn(", ".join(path.name for path in paths), work)

    def open_file(self, path: Path) -> None:
        """Take the inverses of a file in hand."""
        robot = self.workbench.robot

        def work() -> Learned:
            trained, provenance = read_trained(path)
            model = trained.models[trained.chosen]
            check_belongs(robot, NamedInverse(model, provenance.robot, path.name))
            return Learned(trained, provenance, {})

        def done(learned: Learned) -> None:
            self._source = path.name
            self._take(learned)

        self.workbench.work("open inverse", f"Reading {path.name} …", work, done)

    def save_file(self, path: Path) -> None:
        """Keep the inverses in hand."""
        learned = self.learned
        if learned is None:
            return

        def done(_: None) -> None:
            self._source = path.name
            self.workbench.notify(Level.GOOD, f"Saved {path}")

        self.workbench.work(
            "save inverse",
            f"Writing {path.name} …",
            lambda: write_trained(path, learned.trained, learned.provenance),
            done,
        )

    # --- put on -----------------------------------------------------------------------------------

    def switch(self) -> None:
        """Put the chosen inverse on its axis, or take off what is on."""
        session, axis = self.workbench.session, self.controls.chosen
        if axis in session.compensated:
            self.workbench.ask(lambda: session.uncompensate(axis))
            return
        learned, kind = self.learned, self.controls.kind.currentData()
        if learned is None or learned.axis != axis:
            return
        model = learned.trained.models[kind]
        name = f"{NAMES[kind]}, {self._source}"
        inverse = NamedInverse(model, learned.provenance.robot, name)
        self.workbench.ask(lambda: session.compensate(inverse))

    def try_it(self) -> None:
        """Play swings that fade; what is left is shown beside the other state's."""
        robot, session = self.workbench.robot, self.workbench.session
        motion = trial_motion(robot, self.controls.chosen)
        if self.workbench.ask(lambda: session.play(motion)):
            self.tabs.setCurrentIndex(LIVE)

    # --- tune -------------------------------------------------------------------------------------

    def tune(self) -> None:
        """Search gains; the front is drawn as it evolves."""
        robot, axis = self._robot(), self.controls.chosen
        learned = self.learned if self.controls.forward.isChecked() else None
        model = None if learned is None else learned.trained.models[learned.trained.chosen]
        settings = SearchSettings(generations=self.controls.generations.value())
        name = self._source if model is not None else ""
        self._enough = enough = Flag()
        self._searching = True
        self.tuning = self._problem = None
        self.tabs.setCurrentIndex(FRONT)

        def work(tell: Tell) -> tuple[Any, Tuning]:
            tell("Preparing the simulated loop", 0.0, None)
            problem = problem_of(robot, axis, model)

            def told(found: Generation) -> bool:
                done = f"{found.done} of {found.total} generations, {len(found.front)} points"
                tell(done, found.share, found)
                return not enough.is_set()

            return problem, search(problem, settings, told, name)

        self.job.start(work)

    def pick(self, number: int) -> None:
        """Take a point of the front, and try it on a step and a triangle."""
        tuning, problem = self.tuning, self._problem
        if tuning is None or problem is None:
            return
        self.tuning = tuning.choosing(number)
        point = self.tuning.best
        self.front.mark(number)
        self.controls.point.setText(point_text(point, number))
        self._trying.start(lambda _: problem.try_out(point.gains)[0])

    def keep(self, path: Path) -> None:
        """Write the tuning with the point that was taken."""
        tuning = self.tuning
        if tuning is not None:
            self.workbench.work(
                "keep tuning",
                f"Writing {path.name} …",
                lambda: save_tuning(tuning, path),
                lambda _: self.workbench.notify(Level.GOOD, f"Saved {path}"),
            )

    def stop(self) -> None:
        """Stop the machine's trial, or end what is worked on; a search keeps what it found."""
        if self._searching:
            self._enough.set()
        elif self.job.running:
            self.job.stop()
            self.controls.tell("Stopped; nothing was replaced.", None)
        else:
            self.workbench.stop()

    # --- inside -----------------------------------------------------------------------------------

    def _robot(self) -> Robot:
        """Return the robot with the effects that act on the simulated machine just now."""
        robot, effects = self.workbench.robot, self.workbench.session.effects
        return robot if effects is None else replace(robot, effects=effects)

    def _learn(self, source: str, work: Callable[[Listener], Learned]) -> None:
        self._searching = False

        def named(tell: Tell) -> tuple[str, Learned]:
            return source, work(lambda what, share: tell(what, share, None))

        self.controls.tell("Learning …", 0.0)
        self.job.start(named)

    def _told(self, what: str, share: float, news: object) -> None:
        self.controls.tell(what, share)
        if isinstance(news, Generation):
            self.front.show_generation(news, SearchSettings().against)

    def _finished(self, answer: tuple[Any, Any]) -> None:
        self.controls.tell("", None)
        if self._searching:
            self._searching = False
            self._problem, self.tuning = answer
            self.front.show_tuning(self.tuning)
            self.pick(self.tuning.recommended)
            return
        self._source, learned = answer
        self._take(learned)

    def _failed(self, message: str) -> None:
        self._searching = False
        self.controls.tell("It failed; nothing was replaced.", None)
        self.workbench.notify(Level.ERROR, f"Compensation: {message}")

    def _take(self, learned: Learned) -> None:
        self.learned = learned
        kinds = self.controls.kind
        kinds.clear()
        for kind in learned.trained.models:
            said = " (recommended)" if kind == learned.trained.chosen else ""
            kinds.addItem(NAMES[kind] + said, kind)
        kinds.setCurrentIndex(kinds.findData(learned.trained.chosen))
        self.controls.axis.setCurrentIndex(self.controls.axis.findData(learned.axis))
        self.check.show_learned(learned)
        self.tabs.setCurrentIndex(CHECK)

    def _show_tries(self, tries: tuple[Try, Try]) -> None:
        assert self.tuning is not None, "a point was taken"
        self.front.show_tries(*tries, self._unit(self.tuning.axis))

    def _forget_trials(self) -> None:
        self.trials.clear()
        self.live.clear()

    def _heard(self, event: Event) -> None:
        if not isinstance(event, PlaybackFinished) or event.record is None or not event.completed:
            return
        trial = trial_of(event.record, self.controls.chosen)
        if trial is not None:
            self.trials[trial.compensated] = trial
            self.live.show_trial(trial, self._unit(self.controls.chosen))

    def _come_forward(self, run: Run) -> None:
        """Come to the front again after a trial: the comparison of it has come there."""
        if run.record.metadata.get("trajectory") == NAME:
            QTimer.singleShot(0, self._raise)

    def _raise(self) -> None:
        dock = self.parentWidget()
        while dock is not None and not isinstance(dock, QDockWidget):
            dock = dock.parentWidget()
        if dock is not None:
            dock.raise_()

    def _unit(self, axis: str) -> str:
        return self.workbench.robot.unit(axis) or "m"

    def _refresh(self, state: SessionState) -> None:
        controls, session, axis = self.controls, self.workbench.session, self.controls.chosen
        unit = self._unit(axis) if axis else "m"
        controls.before.setText(left(self.trials.get(False), unit))
        controls.after.setText(left(self.trials.get(True), unit))
        on = axis in session.compensated
        controls.switch.setText("Take off" if on else "Put on")
        controls.beyond.setText(beyond(session.beyond_inverse(axis)))
        no_axis = None if axis else "the robot has no piezo in open loop"
        busy = "work is under way; stop it or wait" if self.job.running else no_axis
        record = None if self.workbench.record is not None else "no record is in hand"
        none = None if self.learned is not None else NOTHING
        other = self._other(axis)
        still = state.locked or (None if state.activity is DeviceState.IDLE else "it moves")
        point = None if self.tuning is not None else "there is no front yet: tune first"
        allow(controls.simulate, busy, "Move the simulated axis over its range and learn from it")
        allow(controls.record, busy or record, "Learn from the record in hand")
        allow(controls.files, busy, "Learn from records with cmd and meas, or ref")
        allow(controls.open, busy, "Take the inverses of a file")
        allow(controls.save, none, "Keep these inverses in a file")
        allow(controls.switch, still or (None if on else other), self._switch_tip())
        allow(controls.trial, still or no_axis, "Play 6 s of swings over 60 % of the range")
        allow(controls.tune, busy, "Search gains of a PID loop at 5 kHz on the simulated axis")
        allow(controls.forward, other, "Feed the reference forward through the inverse in hand")
        allow(controls.keep, busy or point, "Write the front with the point that is marked")
        working = self.job.running or state.activity is DeviceState.PLAYING
        allow(controls.stop, None if working else "nothing is under way", "End it")

    def _other(self, axis: str) -> str | None:
        """Return why the inverse in hand is none for an axis; None if it is one."""
        if self.learned is None:
            return NOTHING
        mine = self.learned.axis
        return None if mine == axis else f"the inverse in hand is of axis {mine}"

    def _switch_tip(self) -> str:
        if self.workbench.session.compensates_all:
            return "Every set-point of this axis goes through the inverse; the axis stays in place"
        return "Played trajectories go through the inverse; single moves go as they are told"

    def _connect(self) -> None:
        controls = self.controls
        for button, action in (
            (controls.simulate, self.learn_simulated),
            (controls.record, self.learn_record),
            (controls.switch, self.switch),
            (controls.trial, self.try_it),
            (controls.tune, self.tune),
            (controls.stop, self.stop),
        ):
            button.clicked.connect(action)
        controls.axis.currentIndexChanged.connect(self._forget_trials)
        self._ask(controls.files, "Records", RECORDS, self.learn_files)
        self._ask(controls.open, "Inverses", INVERSES, lambda paths: self.open_file(paths[0]))
        self._ask(controls.save, "Keep inverses", INVERSES, lambda paths: self.save_file(paths[0]))
        self._ask(controls.keep, "Keep gains", TUNINGS, lambda paths: self.keep(paths[0]))
        self.job.told.connect(self._told)
        self.job.finished.connect(self._finished)
        self.job.failed.connect(self._failed)
        self._trying.finished.connect(self._show_tries)
        self._trying.failed.connect(self._failed)
        self.front.picked.connect(self.pick)
        self.tabs.currentChanged.connect(self.views.setCurrentIndex)
        self._happened.connect(self._heard)
        self._unsubscribe = self.workbench.session.subscribe(self._happened.emit)
        self.workbench.refreshed.connect(self._refresh)
        self.workbench.theme_changed.connect(self._use_theme)
        self.workbench.run_changed.connect(self._come_forward)
        self.workbench.closing.connect(self._close)

    def _ask(
        self, button: QPushButton, title: str, kinds: str, done: Callable[[list[Path]], None]
    ) -> None:
        """Let a button ask for files; one that begins with "Keep" or "Save" names a new one."""

        def ask() -> None:
            folder = self.workbench.settings.get("files.folder", "")
            dialog = QFileDialog(self, title, folder, kinds)
            dialog.setOption(QFileDialog.Option.DontUseNativeDialog)
            dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
            if title.startswith("Keep"):
                dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
                dialog.setDefaultSuffix(kinds[kinds.index("*.") + 2 :].rstrip(")"))
            elif kinds is RECORDS:
                dialog.setFileMode(QFileDialog.FileMode.ExistingFiles)
            else:
                dialog.setFileMode(QFileDialog.FileMode.ExistingFile)
            dialog.filesSelected.connect(lambda names: done([Path(name) for name in names]))
            dialog.show()

        button.clicked.connect(ask)

    def _use_theme(self, theme: Theme) -> None:
        for view in (self.check, self.live, self.front):
            view.set_theme(theme)

    def _close(self) -> None:
        self._unsubscribe()
        self._enough.set()
        self.job.close()
        self._trying.close()

    def _lay_out(self) -> None:
        scroll = QScrollArea()
        scroll.setObjectName("panelScroll")
        scroll.setFrameShape(QFrame.Shape.NoFrame)
        scroll.setWidgetResizable(True)
        scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        scroll.setWidget(self.controls)
        scroll.setFixedWidth(_WIDTH)
        right = QVBoxLayout()
        right.setSpacing(4)
        right.addWidget(self.tabs)
        right.addWidget(self.views, 1)
        row = QHBoxLayout(self)
        row.setContentsMargins(10, 6, 10, 6)
        row.addWidget(scroll)
        row.addLayout(right, 1)
