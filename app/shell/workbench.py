"""What all panels share: the robot, the motion session, and the trajectory and record in hand."""

import logging
from collections.abc import Callable, Hashable
from enum import StrEnum
from pathlib import Path
from typing import TypeVar

from PySide6.QtCore import QMetaMethod, QTimer, Signal

from rotemina.app.microscope.microscope import Microscope
from rotemina.app.microscope.status import Activity
from rotemina.app.motion.compared_run import Run, compared, compared_again
from rotemina.app.motion.model_in_use import ModelInUse
from rotemina.app.motion.operation import Operation
from rotemina.app.motion.ownership import OPERATOR
from rotemina.app.motion.penetration.status import Phase as PenetrationPhase
from rotemina.app.motion.playback import Playback, PlaybackPhase, PlaybackState
from rotemina.app.motion.recording.replay import Replay
from rotemina.app.motion.resuming import ResumeStep, Resumption
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import (
    Alarmed,
    CommandRefused,
    Connection,
    Event,
    Faulted,
    ModelChanged,
    PlaybackFinished,
    SessionState,
    Stopped,
)
from rotemina.app.records.entry import Entry
from rotemina.app.records.library import commands, read
from rotemina.app.settings import Settings
from rotemina.app.shell.background import Background
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.help_topics import Explained, Until, page_for, page_of
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.loaded_trajectory import Plan
from rotemina.app.shell.operator_requests import Requests
from rotemina.app.shell.penetration_records import PenetrationRecords
from rotemina.app.shell.played_records import PlayedRecords, keeping
from rotemina.app.shell.progress_line import Progress
from rotemina.app.shell.record_library import RecordLibrary
from rotemina.app.shell.replaying import Replaying, opened, remark
from rotemina.app.shell.requests_at_rest import AtRest, WaitingRequest
from rotemina.app.shell.steady_meaning import SteadyMeaning
from rotemina.app.shell.theme import Theme
from rotemina.app.shell.turns import Turns
from rotemina.app.shell.window_state import StateDisplay, WindowSnapshot, describe_state
from rotemina.drivers.gate import Permit
from rotemina.drivers.samples import DeviceState
from rotemina.sim.errors import InputError
from rotemina.sim.messages import PlainText, joined
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record
from rotemina.sim.records.writing import write_record

logger = logging.getLogger(__name__)
Answer = TypeVar("Answer")

FRAME_MS = 33  # screens are read at most this often
#: Said where a request to play is withdrawn before it has had an effect.
NOT_PLAYED = marked("shell", "Not played: {why}. Press Play again.")


class Level(StrEnum):
    """How much a notice matters."""

    INFO = "info"
    GOOD = "good"
    WARNING = "warning"
    ERROR = "error"


class Workbench(Requests):
    """The window's state and its requests; every panel holds the same one.

    What moves or connects the machine is among
    :class:`~rotemina.app.shell.operator_requests.Requests`: a refusal becomes a notice.

    ``plan`` is the loaded trajectory, ``planning`` the name of one whose dry run is under way or
    "", ``run`` the last comparison, ``run_path`` the file of its
    record, ``record`` what would be saved, and ``unsaved`` a played record that no file holds yet:
    each is written into ``played_folder`` by itself as soon as it ends. ``pace`` (times as fast as
    the trajectory says) and ``bounds`` (of the deviation of readings from the model, m or rad by
    axis) are what the next playback is begun with. ``operation`` is what an operator's hand does
    with the machine: input devices, teleoperation, penetration, recorder. Its data go beside
    ``played_folder``.
    ``library`` has every record that was played, recorded or opened. ``microscope`` is camera,
    calibration, clicks and vision. ``progress`` is long work that is under way, see
    :meth:`long_work`. ``source`` is what is shown: the machine, or a replay of ``replaying``;
    whoever draws positions reads ``source`` and ``shown``, and whoever acts on the machine reads
    ``session`` and ``refreshed``. ``turns`` tells which texts are written in a frame.

    Signals
    -------
    refreshed(SessionState) : the machine's, once a frame, at most 30 a second.
    shown(SessionState) : likewise, of what is shown; the same unless that is a replay.
    plan_changed(Plan) : a trajectory was loaded and its dry run is done.
    plan_checked(Plan) : the same, as the machine stands otherwise now.
    model_changed(ModelInUse) : predictions are made with another model from now on.
    run_changed(Run) : a record was opened or a playback ended, and model and real are compared.
    busy_changed(str) : what is being worked on in the background, or "".
    noticed(Level, Explained) : something to tell the operator, a text with its page of the help.
    diagnosis_asked() : the records that are chosen are to be diagnosed.
    speed_limit_asked(Plan, callable, WaitingRequest) : it is to be played by a call, but nothing
        limits the speed of an axis; the request waits for the answer.
    resume_asked(bool) : axes were moved during the pause, and the operator is to choose how to go
        on; False: there is nothing to choose any more.
    stopped() : someone asked for a stop; what waits for an answer is withdrawn.
    theme_changed(Theme)
    closing() : the window goes; what a panel has under way must end before this returns.
    """

    refreshed = Signal(object)
    shown = Signal(object)
    plan_changed = Signal(object)
    plan_checked = Signal(object)
    model_changed = Signal(object)
    run_changed = Signal(object)
    busy_changed = Signal(str)
    noticed = Signal(object, object)
    theme_changed = Signal(object)
    diagnosis_asked = Signal()
    speed_limit_asked = Signal(object, object, object)
    resume_asked = Signal(bool)
    stopped = Signal()
    closing = Signal()
    _happened = Signal(object)
    _exceeded = Signal(object)
    _told = Signal(object)

    def __init__(
        self, session: MotionSession, settings: Settings, theme: Theme, played_folder: Path
    ) -> None:
        super().__init__(session)
        self.played_folder = played_folder
        self.settings = settings
        self.theme = theme
        self.plan: Plan | None = None
        self.planning = ""
        self.run: Run | None = None
        self.run_path: Path | None = None
        self.record: Record | None = None
        self.unsaved: Record | None = None
        self.turns = Turns()
        self.pace = 1.0
        self.bounds: dict[str, float] = {}
        self.progress: Progress | None = None
        self._checked_for: tuple[object, ...] = ()  # plan and standing of the latest check
        self._background = Background(self)
        self._exceeded.connect(self._tell_excess)
        self._told.connect(lambda text: self.notify(Level.WARNING, text, about="motion.md"))
        self.library = RecordLibrary(
            session,
            settings,
            played_folder,
            lambda text: self.notify(Level.WARNING, text, about="recording.md#the-library"),
        )
        self._played = PlayedRecords(
            session, self.library, lambda: self.playback.state.phase, self.work
        )
        self._played.stored.connect(self._note_saved)
        self._played.compared.connect(self.take_run)
        self._played.told.connect(
            lambda text: self.notify(Level.WARNING, text, about="trajectory.md")
        )
        # Before this subscribes itself: when it hears of an end, the playback knows it already.
        self.playback = Playback(session, self._exceeded.emit)
        self.resumption = Resumption(session, self.playback, self.ask_aside, self.refused.emit)
        #: Of what plays, pauses and resumes: what a press does now, and since when.
        self.play_meaning = SteadyMeaning(meaning=PlaybackPhase.IDLE)
        self.operation = Operation(
            session, settings.folder, played_folder.parent, told=self._told.emit
        )
        self.microscope = Microscope(
            session,
            settings.folder,
            recorder=lambda: self.operation.recording,
            penetration=lambda: self.penetration,
            told=self._told.emit,
            settings=settings,
        )
        self._penetrated = PenetrationRecords(self.operation, self._told.emit)
        self._penetrated.stored.connect(lambda _: self.library.refresh())
        self.replaying = Replaying(session, self.operation.penetration)
        self._happened.connect(self._on_event)
        self.refused.connect(lambda reason: self.notify(Level.ERROR, reason, about=page_of(reason)))
        self.withdrawn.connect(
            lambda text: self.notify(Level.WARNING, text, about="motion.md#requests-that-wait")
        )
        self._unsubscribe = session.subscribe(self._happened.emit)
        self._described = self._describe_now()
        #: Makes a request once the machine rests, as one whose effects were switched soon does.
        self.at_rest = AtRest(self)
        self._frames = QTimer(self, interval=FRAME_MS)
        self._frames.timeout.connect(self._refresh)

    def start(self) -> None:
        """Connect to the driver and begin to refresh the panels."""
        self.session.start()
        self.operation.start()
        self.microscope.start()
        self._frames.start()
        self.library.refresh()

    def close(self) -> None:
        """Stop refreshing, end all work and disconnect."""
        self._frames.stop()
        self.closing.emit()
        self._unsubscribe()
        self._played.close()
        self._penetrated.close()
        self.microscope.close()
        self.operation.close()
        self.playback.close()
        self.session.close()
        self._background.end()
        self._aside.end()
        self.library.close()

    @property
    def source(self) -> MotionSession | Replay:
        """What is shown; ``replaying.changed`` tells when it is another."""
        paced = self.replaying.paced
        return self.session if paced is None else paced.replay

    @property
    def penetration(self) -> PenetrationPhase:
        """How far the automatic penetration is."""
        return self.operation.penetration.status.phase

    @property
    def untold(self) -> bool:
        """Whether a playback has ended of which the window has yet to hear."""
        return self._played.untold

    @property
    def busy(self) -> bool:
        """Whether work in the background has yet to end."""
        return self._background.busy

    def notify(
        self,
        level: Level,
        text: str,
        about: object = None,
        *,
        until: Until | None = None,
        subject: Hashable | None = None,
    ) -> None:
        """Tell the operator something.

        ``about`` is the error that is told of, or a widget of the panel that tells, or the name
        of a page: the notice has a "?" that opens the page on it. A text that knows its page, as
        those of failures in the background do, needs none.

        The notice goes when its cause is gone: as soon as ``until`` is true of the session's
        state, or when :attr:`settled` names its ``subject``, the request or work that failed.
        """
        told = Explained(
            text,
            page_for(about),
            subject=subject,
            until=until,
            is_refusal=isinstance(about, InputError),
        )
        logger.log(logging.WARNING if level in (Level.WARNING, Level.ERROR) else logging.INFO, told)
        self.noticed.emit(level, told)

    def refuse(self, text: str, about: object = None) -> None:
        """Tell why nothing was done, as :meth:`notify` does; it goes with the next action."""
        self.notify(Level.ERROR, Explained(text, is_refusal=True), about=about)

    def set_theme(self, theme: Theme) -> None:
        """Change the colours of everything."""
        self.theme = theme
        self.theme_changed.emit(theme)

    # --- the model --------------------------------------------------------------------------------

    def use_model(self, make: Callable[[], ModelInUse]) -> None:
        """Make predictions with another model; a refusal becomes a notice."""

        def work() -> None:
            self.session.use_model(make())

        self.work("model", translate("shell", "Switching the model …"), work, lambda _: None)

    def use_nominal_model(self) -> None:
        """Go back to the model of the robot file."""
        self.use_model(lambda: ModelInUse.nominal_of(self.session.driver))

    # --- motion -----------------------------------------------------------------------------------

    def play(self, permit: Permit | None = None) -> None:
        """Play the planned trajectory; a refusal becomes a notice.

        A ``permit`` is that of the request, where it waited: nothing plays if a stop came since,
        and that is reported. A machine that is about to rest is waited for.
        """
        plan = self.plan
        request = WaitingRequest(self, translate("shell", NOT_PLAYED), permit)
        if self.planning:
            text = translate("shell", "the dry run of {name} has not ended yet")
            request.withdraw(text.format(name=self.planning))
        elif plan is None:
            text = translate("shell", "There is no trajectory to play: load one first.")
            self.notify(
                Level.WARNING,
                text,
                about="trajectory.md",
                until=lambda _: self.plan is not None,
            )
        elif self.ask(plan.dry_run.require):
            checked, pace, bounds = plan.dry_run.require(), self.pace, dict(self.bounds)
            self.at_rest.do(
                request,
                lambda: self.playback.play(
                    checked, speed=pace, bounds=bounds, permit=request.permit
                ),
            )

    def against_toggling(self, state: PlaybackState) -> str | None:
        """Return why a press that plays, pauses or resumes does not count now; None: it does."""
        if self.resumption.waits_for is not ResumeStep.NONE:
            return translate("shell", "the playback is being resumed")
        if state.pausing:
            return translate("shell", "the axes are still moving")
        if not self.play_meaning.is_settled(state.phase):
            return translate("shell", "the button has only just changed")
        return None

    def toggle_playback(self) -> None:
        """Play, pause, or continue, whichever comes next and was shown when it was asked for."""
        state = self.playback.state
        if (why := self.against_toggling(state)) is not None:
            text = translate("shell", "Not done: {why}.").format(why=why)
            self.notify(Level.INFO, text, about="motion.md#playing-by-hand")
        elif state.phase is PlaybackPhase.PLAYING:
            self.ask(lambda: self.playback.pause(by=OPERATOR))
        elif state.phase is PlaybackPhase.IDLE:
            self.play_limited(self.plan, self.play)
        elif state.moved:
            self.resume_asked.emit(True)
        else:
            self.resume_playback(moves_back=False)

    def resume_playback(self, *, moves_back: bool) -> None:
        """Resume when the machine rests; with ``moves_back`` after its axes have returned."""
        self.resumption.begin(self.session.permit(), speed=self.pace, moves_back=moves_back)

    def start_playback_over(self) -> None:
        """Play what is paused again from its first row."""
        permit, pace = self.session.permit(), self.pace
        self.ask_aside(lambda: self.playback.start_over(speed=pace, permit=permit))

    def play_limited(
        self,
        plan: Plan | None,
        play: Callable[[], object],
        request: WaitingRequest | None = None,
    ) -> None:
        """Call ``play``, after the operator has limited axes whose speed nothing limits.

        ``request`` is what waits for that answer, where there is one already.
        """
        checked = None if plan is None else plan.dry_run.checked
        if checked is None or not self.playback.axes_without_speed_limit(checked):
            play()
        elif self.isSignalConnected(QMetaMethod.fromSignal(self.speed_limit_asked)):
            asked = request or WaitingRequest(self, translate("shell", NOT_PLAYED))
            self.speed_limit_asked.emit(plan, play, asked)
        else:
            text = translate(
                "shell",
                "Not played: nothing limits the speed of an axis, and the panel Trajectory, which "
                "asks for a limit, is missing. State a limit in the robot file.",
            )
            self.notify(Level.ERROR, text, about="trajectory.md")

    def step_playback(self, rows: int) -> None:
        """Go some rows on, or back, and rest there."""

        def step() -> None:
            if self.playback.state.phase is PlaybackPhase.IDLE and self.plan is not None:
                self.playback.load_paused(self.plan.dry_run.require())
            self.playback.step(rows)

        self.ask(step)

    def end_playback(self) -> None:
        """Stop, and begin again the next time."""
        self.playback.end(by=OPERATOR)

    # --- files ------------------------------------------------------------------------------------

    def load_trajectory(self, path: Path, columns: str | None = None) -> None:
        """Read a trajectory and try it on the model; the plan changes only if all goes well."""
        self._plan(
            path.name,
            _reading(path.name),
            lambda: read_record(path, columns=columns, robot=self.robot),
        )

    def plan_trajectory(self, name: str, trajectory: Record) -> None:
        """Try a trajectory on the model and take it in hand."""
        self._plan(name, translate("shell", "Dry run …"), lambda: trajectory, renews=True)

    def plan_and_play(
        self,
        name: str,
        trajectory: Record,
        request: WaitingRequest,
        play: Callable[[Plan], object],
    ) -> None:
        """Plan a trajectory and, if its dry run permits it, call ``play`` with the plan.

        The request waits until then; if it is withdrawn meanwhile, nothing is played.
        """

        def done(plan: Plan) -> None:
            self.take_plan(plan)
            if not plan.dry_run.allowed:
                request.give_up()  # taking the plan has reported why
            elif request.waits:
                play(plan)

        def replaced() -> None:
            request.withdraw(translate("shell", "another trajectory was loaded meanwhile"))

        self._plan(
            name,
            translate("shell", "Dry run …"),
            lambda: trajectory,
            done,
            undone=request.give_up,
            replaced=replaced,
        )

    def _plan(
        self,
        name: str,
        doing: str,
        read: Callable[[], Record],
        done: Callable[[Plan], None] | None = None,
        *,
        undone: Callable[[], None] = lambda: None,
        replaced: Callable[[], None] | None = None,
        renews: bool = False,
    ) -> None:
        self.planning = name

        def work() -> Plan:
            return Plan.tried(self.session, name, read())

        def planned(plan: Plan) -> None:
            self.planning = ""
            (done or self.take_plan)(plan)

        def failed() -> None:
            self.planning = ""
            undone()

        self.work("plan", doing, work, planned, failed, replaced=replaced, renews=renews)

    def plan_again(self, plan: Plan) -> None:
        """Try the trajectory in hand again, on another model or device."""
        self.work(
            "plan again",
            translate("shell", "Dry run …"),
            lambda: Plan.tried(self.session, plan.name, plan.trajectory),
            self._renew_plan,
            renews=True,
        )

    def open_record(self, path: Path, columns: str | None = None) -> None:
        """Read a record as "real", compare it with the model, and take it into the library."""

        def work() -> Run:
            record = read_record(path, columns=columns, robot=self.robot)
            return compared(self.session.model, path.name, record)

        def done(run: Run) -> None:
            if columns is None:  # without a header nobody could open it again without asking
                self.library.add(path, run.record, path.name)
            self._take_run(run, path)

        self.read_file("run", path.name, work, done)

    def open_entry(self, entry: Entry) -> None:
        """Compare a record of the library with the model, as :meth:`open_record` does."""

        def work() -> Run:
            return compared(self.session.model, entry.name, read(entry, self.robot))

        self.read_file("run", entry.name, work, lambda run: self._take_run(run, entry.path))

    def load_entry(self, entry: Entry) -> None:
        """Take the commands of a record of the library in hand as a trajectory."""
        self._plan(
            entry.name,
            _reading(entry.name),
            lambda: commands(entry, self.robot, self.session.setpoint_period_s),
        )

    def save_record(self, path: Path) -> None:
        """Write the record in hand to a file; it counts as unsaved until that is done."""
        record = self.record
        if record is None:
            text = translate("shell", "There is no record to save: play or open one first.")
            self.notify(
                Level.WARNING,
                text,
                about="comparison.md",
                until=lambda _: self.record is not None,
            )
            return

        self.write_file(
            "save", path, lambda: write_record(record, path), lambda: self._note_saved(record)
        )

    def open_replay(self, path: Path) -> None:
        """Show a recording in place of the machine."""

        def show(replay: Replay) -> None:
            told = remark(replay, self.robot)
            if self.ask(lambda: self.replaying.show(replay)) and told is not None:
                self.notify(Level.WARNING, told, about=replay)

        opening = translate("shell", "Opening {name} …").format(name=path.name)
        self.work("replay", opening, lambda: opened(path, self.robot), show)

    # --- inside -----------------------------------------------------------------------------------

    def work(
        self,
        kind: str,
        doing: str,
        work: Callable[[], Answer],
        done: Callable[[Answer], None],
        undone: Callable[[], None] = lambda: None,
        *,
        replaced: Callable[[], None] | None = None,
        renews: bool = False,
        subject: Hashable | None = None,
    ) -> None:
        """Do something in the background and hand its answer on; a failure becomes a notice.

        ``kind`` tells requests apart: of one kind only the latest answer counts. One of the same
        ``subject``, which is the kind unless given, settles the notice of an earlier failure when
        it is done. ``doing`` is shown meanwhile; ``undone`` is called after a failure. If a later
        request of the same kind takes its place, ``replaced`` is called; without it a notice says
        so, unless it only ``renews`` what was worked out before, as typing does.
        """
        about = kind if subject is None else subject

        def finished(answer: Answer) -> None:
            self.busy_changed.emit("")
            self.settled.emit(about)
            done(answer)

        def failed(message: str) -> None:
            self.busy_changed.emit("")
            self.notify(Level.ERROR, message, subject=about)
            undone()

        def report_replaced() -> None:
            if not renews:
                text = translate("shell", "Replaced by a newer request: {doing}")
                self.notify(Level.INFO, text.format(doing=doing))
            undone()

        self.busy_changed.emit(doing)
        self._background.run(kind, work, finished, failed, replaced or report_replaced)

    def read_file(
        self,
        kind: str,
        name: object,
        read: Callable[[], Answer],
        done: Callable[[Answer], None],
        undone: Callable[[], None] = lambda: None,
    ) -> None:
        """Read a file of this name as :meth:`work` does."""
        doing = translate("shell", "Reading {name} …").format(name=name)
        self.work(kind, doing, read, done, undone)

    def write_file(
        self,
        kind: str,
        path: Path,
        write: Callable[[], object],
        saved: Callable[[], None] = lambda: None,
    ) -> None:
        """Write a file as :meth:`work` does; say that it is saved, and call ``saved``."""

        def done(_: object) -> None:
            self.notify(Level.GOOD, translate("shell", "Saved {path}").format(path=path))
            saved()

        doing = translate("shell", "Writing {name} …").format(name=path.name)
        # Of a kind of its own: each file that is written is reported.
        self.work(f"{kind} {path}", doing, write, done)

    def long_work(
        self,
        kind: str,
        progress: Progress,
        work: Callable[[Progress], Answer],
        done: Callable[[Answer], None],
        undone: Callable[[], None] = lambda: None,
    ) -> None:
        """Do something that takes long, as :meth:`work` does; the window shows how far it is.

        ``work`` reports to the progress that it is given, and ends where that raises because the
        operator has called it off.
        """

        def finished(answer: Answer) -> None:
            self._end_progress(progress)
            self.settled.emit(kind)
            done(answer)

        def failed(message: str) -> None:
            self._end_progress(progress)
            level = Level.INFO if progress.cancelled else Level.ERROR
            self.notify(level, message, subject=kind)
            undone()

        self.progress = progress
        self._background.run(kind, lambda: work(progress), finished, failed, undone)

    def _end_progress(self, progress: Progress) -> None:
        if self.progress is progress:
            self.progress = None

    def finish_recording(self, done: Callable[[], None], undone: Callable[[], None]) -> None:
        """End the recording that runs, and write all that is to be written, in the background.

        ``done`` is called when nothing is left to be waited for, ``undone`` after a failure.
        """

        def work(_: Progress) -> None:
            if self.operation.recording is not None:
                self.operation.stop_recording()

        progress = Progress(
            translate("shell", "The recording is being merged into one file."), cancellable=False
        )
        self.long_work("last recording", progress, work, lambda _: done(), undone)

    def describe(self, state: SessionState) -> StateDisplay:
        """Return what the window says of the machine in a state; the same all through a frame."""
        described, display = self._described
        return display if described is state else describe_state(self._take_snapshot(state))

    def _describe_now(self) -> tuple[SessionState, StateDisplay]:
        state = self.session.snapshot()
        return state, describe_state(self._take_snapshot(state))

    def _take_snapshot(self, state: SessionState) -> WindowSnapshot:
        activity = self.microscope.runs.activity
        return WindowSnapshot(
            self.robot,
            state,
            self.playback.state,
            self.resumption.waits_for,
            self.operation.penetration.status,
            "" if activity is Activity.NONE else activity,
        )

    def _follow_playback(self) -> None:
        """Resume what is to be resumed, and withdraw a question that needs no answer."""
        self.resumption.step()
        playback = self.playback.state
        self.play_meaning.show(playback.phase)
        # An axis that moves now may come back, or go farther: the question waits for it.
        if playback.phase is not PlaybackPhase.PAUSED or (
            self.session.at_rest and not playback.moved
        ):
            self.resume_asked.emit(False)

    def _refresh(self) -> None:
        state = self.session.snapshot()
        self.turns.begin(state)
        self._follow_playback()
        self._described = state, describe_state(self._take_snapshot(state))
        self._check_plan(state)
        self._played.look()
        self._penetrated.look()
        self.refreshed.emit(state)
        self.at_rest.look(state)
        self.replaying.step()
        source = self.source
        self.shown.emit(state if source is self.session else source.snapshot())
        self.turns.end()

    def _check_plan(self, state: SessionState) -> None:
        """Find out anew whether the plan can be played, where the machine stands otherwise now."""
        plan, session = self.plan, self.session
        if plan is None or state.activity is not DeviceState.IDLE or not state.command:
            return
        asked = plan, session.standing
        if asked[1] == plan.standing or asked == self._checked_for:
            return
        self._checked_for = asked

        def done(checked: Plan) -> None:
            if self.plan is plan:
                self.plan = checked
                self.plan_checked.emit(checked)

        self._background.run(
            "plan from here", lambda: plan.from_here(session), done, self.refused.emit
        )

    def take_plan(self, plan: Plan) -> None:
        """Take a trajectory in hand that was tried on the model."""
        if self.playback.state.phase is PlaybackPhase.PAUSED:
            self.playback.end()  # what was paused is not what is in hand
        self.session.dismiss_stop()
        self.plan = plan
        self.plan_changed.emit(plan)
        self._tell_objection(plan)

    def _tell_objection(self, plan: Plan) -> None:
        """Show why a plan cannot be played, until another is loaded or this one can be."""
        if not plan.objection:
            return

        def is_over(_: SessionState) -> bool:
            now = self.plan
            return now is None or now.trajectory is not plan.trajectory or not now.objection

        self.notify(
            Level.WARNING,
            joined((PlainText(plan.name), plan.objection), ": "),
            about=page_of(plan.objection) or "trajectory.md",
            until=is_over,
        )

    def _renew_plan(self, plan: Plan) -> None:
        """Take the same trajectory in hand with another dry run; what is paused stays so."""
        if self.plan is None or self.plan.trajectory is not plan.trajectory:
            return  # another one is in hand by now
        self.plan = plan
        self.plan_changed.emit(plan)

    def _renew_run(self, run: Run) -> None:
        """Take the same record in hand beside another model."""
        if self.run is not None and self.run.record is run.record:
            self.take_run(run, self.run_path)

    def take_run(self, run: Run, path: Path | None = None) -> None:
        """Take a comparison in hand; ``path`` is the file of its record, where there is one."""
        self.run, self.run_path = run, path
        self.record = run.record
        self.run_changed.emit(run)

    def _take_run(self, run: Run, path: Path) -> None:
        """Take a record in hand that is in a file of the library."""
        self.library.set_gap(path, run)
        self.take_run(run, path.absolute())

    def _on_event(self, event: Event) -> None:
        if isinstance(event, Faulted):
            self.notify(Level.ERROR, event.message, about=event, until=self._fault_is_over())
        elif isinstance(event, CommandRefused):
            text = Explained(event.message, is_refusal=True)
            self.notify(Level.ERROR, text, about=event, until=self._device_is_other())
        elif isinstance(event, Alarmed):
            self.notify(Level.WARNING, event.message, about=event, until=self._device_is_other())
        elif isinstance(event, Stopped):
            logger.info("%s", event.request)
            self.stopped.emit()
        elif isinstance(event, PlaybackFinished) and event.shown:
            self._take_played(event)
        elif isinstance(event, ModelChanged):
            self._take_model(event)

    def _device_is_other(self) -> Until:
        """Return what says whether another device than now is in use."""
        driver = self.session.driver
        return lambda _: self.session.driver is not driver

    def _fault_is_over(self) -> Until | None:
        """Return what says whether that is over which locks motion now; None for nothing.

        A fault is over when it is cleared, a lost link when there is one again, a doubt about the
        position when that is confirmed, and each when another device is in use.
        """
        state, is_other = self.session.snapshot(), self._device_is_other()
        if state.connection is not Connection.CONNECTED:
            return lambda now: is_other(now) or now.connection is Connection.CONNECTED
        if state.fault is not None:
            return lambda now: is_other(now) or now.fault is None
        if state.doubt is not None:
            return lambda now: is_other(now) or now.doubt is None
        return None

    def _tell_excess(self, excess: str) -> None:
        self.notify(
            Level.ERROR,
            translate(
                "shell",
                "Playback paused: {text}. Check the machine, then resume or end the playback.",
            ).format(text=excess),
            about="motion.md#playing-by-hand",
            until=self._excess_is_over,
        )

    def _excess_is_over(self, _: SessionState) -> bool:
        state = self.playback.state
        return state.phase is PlaybackPhase.IDLE or not state.excess

    def _note_saved(self, record: Record) -> None:
        if self.unsaved is record:
            self.unsaved = None
        self.settled.emit(keeping(record))

    def _take_played(self, event: PlaybackFinished) -> None:
        """Take the record of a playback in hand, until it is compared; its plan names it."""
        if event.record is not None:
            self.record = self.unsaved = event.record
        self._played.take(event, self.plan.name if self.plan else "playback")

    def _take_model(self, event: ModelChanged) -> None:
        """Show everything by another model."""
        logger.info("model in use: %s", event.model.id)
        if event.why:
            text = translate("shell", "The nominal model is in use again: {why}.")
            self.notify(
                Level.WARNING,
                text.format(why=spoken(event.why)),
                about="model.md",
                until=lambda _: self.session.model is not event.model,
            )
        self.model_changed.emit(event.model)
        plan, run = self.plan, self.run
        if plan is not None:
            self.plan_again(plan)
        if run is not None:
            self.work(
                "run again",
                translate("shell", "Comparing model and machine …"),
                lambda: compared_again(event.model, run, self.session.memory),
                self._renew_run,
                renews=True,
            )


def _reading(name: str) -> str:
    return translate("shell", "Reading {name} …").format(name=name)
