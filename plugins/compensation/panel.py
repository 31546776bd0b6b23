"""Compensation of hysteresis: train, check, apply, tune."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import Signal

from rotemina.app.motion.compensation import NamedInverse, check_belongs
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import Area, Panel, offer_in_palette
from rotemina.app.shell.background_job import Job, Tell
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.file_dialog import ask_file, ask_files, ask_where
from rotemina.app.shell.language import marked
from rotemina.app.shell.theme import Theme
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import allow
from rotemina.app.widgets.scroll_areas import lay_beside, tabbed
from rotemina.app.widgets.tab_dots import TabNews
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.compensation import mark, tr
from rotemina.plugins.compensation.controls import Controls
from rotemina.plugins.compensation.gain_search import GainSearch
from rotemina.plugins.compensation.inverse_training import (
    Learned,
    Listener,
    learned_from,
    learned_simulated,
)
from rotemina.plugins.compensation.machine_actions import Actuation
from rotemina.plugins.compensation.plot_views import CheckView, FrontView, LiveView
from rotemina.plugins.compensation.words import NO_FRONT, NOTHING, kind_name
from rotemina.sim.compensate.file import read_trained, write_trained
from rotemina.sim.records.reading import read_record
from rotemina.sim.robot.model import Robot

RECORDS = mark("Records (*.csv *.txt *.dat *.gz);;All files (*)")
INVERSES = mark("Inverses (*.json)")
TUNINGS = mark("Tunings (*.toml)")
CHECK, LIVE, FRONT = range(3)  # tabs
_WIDTH = 300  # of the controls at least, px
_SEED = 0


class CompensationPanel(Panel):
    """Controls beside the judgement, the live loops and the search of gains."""

    title = marked("panels", "Compensation")
    area = Area.BOTTOM
    order = 33
    help_page = "compensation.md#the-panel"
    _happened = Signal(object)

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        theme = workbench.theme
        self.controls = Controls(workbench.robot)
        self.check, self.live, self.front = CheckView(theme), LiveView(theme), FrontView(theme)
        self.actuation = Actuation(workbench, self.controls, self.live)
        self.search = GainSearch(workbench, self.controls, self.front)
        self.job = Job(self)
        self.learned: Learned | None = None
        self._source = ""
        self.tabs, self.views = tabbed(
            tr("View"), {tr("Check"): self.check, tr("Live"): self.live, tr("Tuning"): self.front}
        )
        self.news = TabNews(self.tabs)
        lay_beside(self, self.controls, _WIDTH, self.tabs, self.views)
        self._connect()
        offer_in_palette(self.controls.switch, self.controls.apply, self.controls.trial)
        harmless = self.controls.save, self.controls.tune, self.controls.keep, self.controls.stop
        offer_in_palette(*harmless, safe_while_hidden=True)
        self._change_axis()
        self.controls.tell("", None)

    # --- learn ------------------------------------------------------------------------------------

    def learn_simulated(self) -> None:
        """Move the simulated axis with the machine's effects, and learn from that."""
        robot, axis = self._robot(), self.controls.chosen
        self._learn(
            "simulator", lambda tell: learned_simulated(robot, robot.effects, axis, _SEED, tell)
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

        self.workbench.read_file("open inverse", path.name, work, done)

    def save_file(self, path: Path) -> None:
        """Keep the inverses in hand."""
        learned = self.learned
        if learned is None:
            return

        def done() -> None:
            self._source = path.name

        self.workbench.write_file(
            "save inverse",
            path,
            lambda: write_trained(path, learned.trained, learned.provenance),
            done,
        )

    # --- act and tune -----------------------------------------------------------------------------

    def try_it(self) -> None:
        """Play decaying swings, and show the error beside those of other states."""
        self.tabs.setCurrentIndex(LIVE)
        self.actuation.try_it()

    def tune(self) -> None:
        """Search gains; the front is drawn as it evolves."""
        learned = self.learned if self.controls.forward.isChecked() else None
        model = None if learned is None else learned.trained.models[learned.trained.chosen]
        self.tabs.setCurrentIndex(FRONT)
        self.search.tune(self._robot(), self.controls.chosen, model, self._source)

    def stop(self) -> None:
        """Stop the machine's trial, or end what is worked on; a search keeps what it found."""
        if self.search.running:
            self.search.stop()
        elif self.job.running:
            self.job.stop()
            self.controls.tell(tr("Stopped; nothing was replaced."), None)
        else:
            self.workbench.stop()

    # --- inside -----------------------------------------------------------------------------------

    def _robot(self) -> Robot:
        """Return the robot with the effects that act on the simulated machine at present."""
        robot, effects = self.workbench.robot, self.workbench.session.service.effects
        return robot if effects is None else replace(robot, effects=effects)

    def _learn(self, source: str, work: Callable[[Listener], Learned]) -> None:
        def named(tell: Tell) -> tuple[str, Learned]:
            return source, work(lambda what, share: tell(what, share, None))

        self.controls.tell(tr("Training …"), 0.0)
        self.job.start(named)

    def _told(self, what: str, share: float, _news: object) -> None:
        self.controls.tell(spoken(what), share)

    def _finished(self, answer: tuple[str, Learned]) -> None:
        self.controls.tell("", None)
        self.workbench.settled.emit(self)
        self._source, learned = answer
        self._take(learned)

    def _failed(self, message: str) -> None:
        self.controls.tell(tr("Failed; nothing was replaced."), None)
        text = tr("Compensation: {message}")
        self.workbench.notify(Level.ERROR, text.format(message=message), about=self, subject=self)

    def _take(self, learned: Learned) -> None:
        self.learned = learned
        kinds = self.controls.kind
        kinds.clear()
        for kind in learned.trained.models:
            name = kind_name(kind)
            if kind == learned.trained.chosen:
                name = tr("{inverse} (recommended)").format(inverse=name)
            kinds.addItem(name, kind)
        kinds.setCurrentIndex(kinds.findData(learned.trained.chosen))
        self.controls.axis.setCurrentIndex(self.controls.axis.findData(learned.axis))
        self.check.show_learned(learned)
        self.news.mark(CHECK)

    def _refresh(self, state: SessionState) -> None:
        controls, axis = self.controls, self.controls.chosen
        no_axis = None if axis else tr("the robot has no piezo in open loop")
        running = self.job.running or self.search.running
        busy = tr("work is in progress; stop it or wait") if running else no_axis
        record = None if self.workbench.record is not None else tr("there is no record")
        none = None if self.learned is not None else tr(NOTHING)
        other = self._other(axis)
        point = None if self.search.tuning is not None else tr(NO_FRONT)
        self.actuation.refresh(state, other)
        allow(
            controls.simulate, busy, tr("Train with a motion of the simulated axis over its range")
        )
        allow(controls.record, busy or record, tr("Train with the last record"))
        allow(controls.files, busy, tr("Train with records that have cmd and meas or ref"))
        allow(controls.open, busy, tr("Load inverses from a file"))
        allow(controls.save, none, tr("Save these inverses to a file"))
        allow(controls.tune, busy, tr("Search gains of a PID loop at 5 kHz on the simulated axis"))
        allow(controls.forward, other, tr("Feed the reference forward through the current inverse"))
        allow(controls.keep, busy or point, tr("Save the front with the selected point"))
        allow(controls.open_gains, busy, tr("Load gains from a file that rotemina tune wrote"))
        working = running or state.activity is DeviceState.PLAYING
        allow(controls.stop, None if working else tr("nothing is running"), tr("Stop the work"))

    def _other(self, axis: str) -> str | None:
        """Return why the inverse in hand is none for an axis; None if it is one."""
        if self.learned is None:
            return tr(NOTHING)
        mine = self.learned.axis
        if mine == axis:
            return None
        return tr("the current inverse belongs to axis {axis}").format(axis=mine)

    def _connect(self) -> None:
        controls = self.controls
        for button, action in (
            (controls.simulate, self.learn_simulated),
            (controls.record, self.learn_record),
            (controls.switch, lambda: self.actuation.switch(self.learned, self._source)),
            (controls.apply, lambda: self.actuation.apply(self.search.tuning, self.search.name)),
            (controls.sweep, self.actuation.sweep),
            (controls.trial, self.try_it),
            (controls.tune, self.tune),
            (controls.stop, self.stop),
        ):
            button.clicked.connect(action)
        controls.axis.currentIndexChanged.connect(lambda _: self._change_axis())
        controls.files.clicked.connect(self._ask_records)
        controls.open.clicked.connect(self._ask_inverses)
        controls.save.clicked.connect(self._ask_where_inverses)
        controls.keep.clicked.connect(self._ask_where_gains)
        controls.open_gains.clicked.connect(self._ask_gains)
        self.job.told.connect(self._told)
        self.job.finished.connect(self._finished)
        self.job.failed.connect(self._failed)
        self.search.failed.connect(self._failed)
        self._happened.connect(self.actuation.on_event)
        self._unsubscribe = self.workbench.session.subscribe(self._happened.emit)
        self.follow(self._refresh)
        self.workbench.theme_changed.connect(self._use_theme)
        self.workbench.closing.connect(self._close)

    def _ask_records(self) -> None:
        title, kinds = tr("Records"), tr(RECORDS)
        ask_files(self, self.workbench, title, kinds, self.learn_files)

    def _ask_inverses(self) -> None:
        title, kinds = tr("Inverses"), tr(INVERSES)
        ask_file(self, self.workbench, title, kinds, self.open_file)

    def _ask_where_inverses(self) -> None:
        title = tr("Save inverses")
        ask_where(self, self.workbench, title, tr(INVERSES), "inverses.json", self.save_file)

    def _ask_gains(self) -> None:
        title, kinds = tr("Gains"), tr(TUNINGS)
        ask_file(self, self.workbench, title, kinds, self.search.open)

    def _ask_where_gains(self) -> None:
        title, kinds = tr("Save gains"), tr(TUNINGS)
        ask_where(self, self.workbench, title, kinds, "gains.toml", self.search.keep)

    def _change_axis(self) -> None:
        """Forget the trials of another axis; what is drawn of none yet has this one's unit."""
        self.actuation.forget()
        axis = self.controls.chosen
        unit = (self.workbench.robot.unit(axis) if axis else None) or "m"
        self.live.set_unit(unit)
        if self.learned is None:
            self.check.set_unit(unit)
        tuning = self.search.tuning
        if tuning is None:
            self.front.set_unit(unit)
        shown = tuning.best.gains if tuning is not None and tuning.axis == axis else None
        self.controls.typed.show_gains(axis, shown)

    def _use_theme(self, theme: Theme) -> None:
        for view in (self.check, self.live, self.front):
            view.set_theme(theme)

    def _close(self) -> None:
        self._unsubscribe()
        self.job.close()
        self.search.close()
