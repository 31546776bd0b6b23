"""Data and actions shared by all panels, assembled from parts, and the refresh of the screen."""

from pathlib import Path

from PySide6.QtCore import QTimer, Signal

from rotemina.app.microscope import Microscope
from rotemina.app.motion.model import ModelInUse
from rotemina.app.motion.penetration import PenetrationPhase as PenetrationPhase
from rotemina.app.motion.playback import ComparedRun as ComparedRun
from rotemina.app.motion.recording import Replay
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import PlaybackFinished
from rotemina.app.operation import OperatorControl
from rotemina.app.settings import UserSettings
from rotemina.app.widgets.style import Theme
from rotemina.app.workbench.job_runner import JobRunner
from rotemina.app.workbench.loaded_trajectory import TrajectoryPlan
from rotemina.app.workbench.machine_monitor import MachineMonitor
from rotemina.app.workbench.notice_poster import Level as Level, NoticePoster
from rotemina.app.workbench.operator_requests import OperatorRequests
from rotemina.app.workbench.playback_controller import NOT_PLAYED as NOT_PLAYED, PlaybackController
from rotemina.app.workbench.played_records import PlaybackRecords
from rotemina.app.workbench.record_library import RecordLibrary
from rotemina.app.workbench.record_manager import RecordManager
from rotemina.app.workbench.requests_at_rest import AtRestScheduler
from rotemina.app.workbench.state_describer import StateDescriber
from rotemina.app.workbench.trajectory_planner import TrajectoryPlanner
from rotemina.app.workbench.turns import StaggeredRefresh
from rotemina.sim.compatibility import FormerMember
from rotemina.sim.records import Record

# Shortest time between two refreshes of the screen.
FRAME_MS = 33


class Workbench(OperatorRequests):
    """The window's state and its requests, shared by all panels.

    Requests that move or connect the machine are in
    :class:`~rotemina.app.workbench.OperatorRequests`. Everything else is in the parts, from
    ``notices`` to ``records``. Panels find the members that they use here, under the same names.

    Attributes
    ----------
    notices : NoticePoster
    jobs : JobRunner
        Work in the background.
    machine : MachineMonitor
        Events of the machine, and the model in use.
    planner : TrajectoryPlanner
        The loaded trajectory and its dry run.
    player : PlaybackController
        Playing it.
    records : RecordManager
        The compared run, the record to save, and replays. Code that draws positions reads
        ``source`` and ``shown``; code that acts on the machine reads ``session`` and
        ``refreshed``.
    library : RecordLibrary
        Every record that was played, recorded or opened.
    at_rest : AtRestScheduler
        Makes a request as soon as the machine rests.
    operation : OperatorControl
        Manual operation: input devices, teleoperation, penetration, recorder. Its data are saved
        next to ``played_folder``.
    microscope : Microscope
        Camera, calibration, clicks and vision.
    turns : StaggeredRefresh

    Signals
    -------
    refreshed(SessionState) : the machine's state, once per frame, at most 30 times a second.
    shown(SessionState) : likewise, the state of what is shown; it differs only in a replay.
    notice_posted, plan_changed, plan_checked, run_changed, speed_limit_asked, stopped : see the
        parts.
    model_changed(ModelInUse) : predictions now use another model.
    diagnosis_asked() : the operator asked to diagnose the chosen records.
    theme_changed(Theme)
    closing() : the window closes; a panel must end its work before its slot for this signal
        returns.
    """

    refreshed = Signal(object)
    shown = Signal(object)
    model_changed = Signal(object)
    theme_changed = Signal(object)
    diagnosis_asked = Signal()
    closing = Signal()

    def __init__(
        self, session: MotionSession, settings: UserSettings, theme: Theme, played_folder: Path
    ) -> None:
        super().__init__(session)
        self.played_folder = played_folder
        self.settings = settings
        self.theme = theme
        self.turns = StaggeredRefresh()
        self.notices = notices = NoticePoster(self)
        notices.settled.connect(self.settled)
        self.jobs = jobs = JobRunner(notices)
        self.at_rest = AtRestScheduler(self)
        self.library = RecordLibrary(
            session,
            settings,
            played_folder,
            lambda text: self.notify(Level.WARNING, text, about="recording.md#the-library"),
        )
        # Each of the following objects receives an event of the session before the next one does.
        playback_records = PlaybackRecords(
            session, self.library, lambda: self.player.phase, jobs.work
        )
        self.planner = TrajectoryPlanner(self, jobs, notices)
        self.player = PlaybackController(self, self.planner, self.at_rest, notices)
        self.operation = OperatorControl(
            session, settings.folder, played_folder.parent, notify=notices.warn_from_any_thread
        )
        self.microscope = Microscope(
            session,
            settings.folder,
            get_recorder=lambda: self.operation.recording,
            read_penetration_phase=lambda: self.penetration,
            notify=notices.warn_from_any_thread,
            settings=settings,
        )
        self._describer = StateDescriber(self.robot, self.player, self.operation, self.microscope)
        self.records = RecordManager(
            self, self.library, playback_records, self.operation, jobs, notices
        )
        self.machine = MachineMonitor(self, jobs, notices)
        self.machine.playback_finished.connect(self._on_playback_finished)
        self.machine.model_replaced.connect(self._on_model_replaced)
        self._share_members()
        self._frame_timer = QTimer(self, interval=FRAME_MS)
        self._frame_timer.timeout.connect(self._refresh)

    def _share_members(self) -> None:
        """Make the methods and signals that panels use available under the same names here."""
        notices, jobs, machine = self.notices, self.jobs, self.machine
        planner, player, records = self.planner, self.player, self.records
        self.describe = self._describer.describe
        self.notify = notices.notify
        self.refuse = notices.refuse
        self.notice_posted = notices.posted
        self.work = jobs.work
        self.read_file = jobs.read_file
        self.write_file = jobs.write_file
        self.use_model = machine.use_model
        self.stopped = machine.stopped
        self.plan_trajectory = planner.plan_trajectory
        self.plan_and_play = planner.plan_and_play
        self.load_entry = planner.load_entry
        self.take_plan = planner.take_plan
        self.plan_changed = planner.plan_changed
        self.plan_checked = planner.plan_checked
        self.playback = player.playback
        self.play = player.play
        self.toggle_playback = player.toggle_playback
        self.find_toggle_objection = player.find_toggle_objection
        self.play_with_speed_limit = player.play_with_speed_limit
        self.step_playback = player.step_playback
        self.end_playback = player.end_playback
        self.speed_limit_asked = player.speed_limit_asked
        self.open_entry = records.open_entry
        self.open_replay = records.open_replay
        self.take_run = records.take_run
        self.finish_recording = records.finish_recording
        self.replaying = records.replaying
        self.run_changed = records.run_changed

    @property
    def plan(self) -> TrajectoryPlan | None:
        """The loaded trajectory."""
        return self.planner.plan

    @property
    def planning(self) -> str:
        """Name of a trajectory whose dry run is in progress, or ""."""
        return self.planner.planning

    @property
    def pace(self) -> float:
        """Speed of the next playback as a multiple of the trajectory's own."""
        return self.player.pace

    @pace.setter
    def pace(self, pace: float) -> None:
        self.player.pace = pace

    @property
    def bounds(self) -> dict[str, float]:
        """Largest permitted deviation from the model in the next playback, by axis, m or rad."""
        return self.player.bounds

    @bounds.setter
    def bounds(self, bounds: dict[str, float]) -> None:
        self.player.bounds = bounds

    @property
    def run(self) -> ComparedRun | None:
        """The latest comparison."""
        return self.records.run

    @property
    def record(self) -> Record | None:
        """The record that would be saved."""
        return self.records.record

    @record.setter
    def record(self, record: Record | None) -> None:
        self.records.record = record

    @property
    def source(self) -> MotionSession | Replay:
        """The machine or the replay that is shown; ``replaying.changed`` reports a change."""
        return self.records.source

    @property
    def has_unhandled_playback(self) -> bool:
        """Whether a playback has ended that the window has not handled yet."""
        return self.records.has_unhandled_playback

    @property
    def busy(self) -> bool:
        """Whether work in the background is in progress."""
        return self.jobs.busy

    @property
    def penetration(self) -> PenetrationPhase:
        """Phase of the automatic penetration."""
        return self.operation.penetration.status.phase

    def start(self) -> None:
        """Connect to the driver and start refreshing the panels."""
        self.session.start()
        self.operation.start()
        self.microscope.start()
        self._frame_timer.start()
        self.library.refresh()

    def close(self) -> None:
        """Stop refreshing, end all work and disconnect."""
        self._frame_timer.stop()
        self.closing.emit()
        self.machine.close()
        self.records.close()
        self.microscope.close()
        self.operation.close()
        self.player.close()
        self.session.close()
        self.jobs.close()
        self._aside.end()
        self.library.close()

    def set_theme(self, theme: Theme) -> None:
        """Change the colours of the window and all panels."""
        self.theme = theme
        self.theme_changed.emit(theme)

    def _refresh(self) -> None:
        state = self.session.snapshot()
        self.turns.begin_frame(state)
        self.player.follow_playback()
        self._describer.begin_frame(state)
        self.planner.recheck_plan(state)
        self.records.update()
        self.refreshed.emit(state)
        self.at_rest.make_if_resting(state)
        self.replaying.step()
        source = self.source
        self.shown.emit(state if source is self.session else source.snapshot())
        self.turns.end_frame()

    def _on_playback_finished(self, event: PlaybackFinished) -> None:
        self.records.take_playback(event, self.plan.name if self.plan else "playback")

    def _on_model_replaced(self, model: ModelInUse) -> None:
        self.model_changed.emit(model)
        if self.plan is not None:
            self.planner.plan_again(self.plan)
        self.records.compare_again(model)

    # Former names, which work for one more release; those with a dot are now only in a part.
    against_toggling = FormerMember("find_toggle_objection")
    ask = FormerMember("run_request")
    noticed = FormerMember("notice_posted")
    play_limited = FormerMember("play_with_speed_limit")
    untold = FormerMember("has_unhandled_playback")
    busy_changed = FormerMember("jobs.busy_changed")
    load_trajectory = FormerMember("planner.load_trajectory")
    long_work = FormerMember("jobs.long_work")
    open_record = FormerMember("records.open_record")
    plan_again = FormerMember("planner.plan_again")
    progress = FormerMember("jobs.progress")
    resume_asked = FormerMember("player.resume_asked")
    resume_playback = FormerMember("player.resume_playback")
    run_path = FormerMember("records.run_path")
    save_record = FormerMember("records.save_record")
    start_playback_over = FormerMember("player.start_playback_over")
    unsaved = FormerMember("records.unsaved")
    use_nominal_model = FormerMember("machine.use_nominal_model")
