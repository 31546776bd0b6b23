"""The loaded trajectory: read, simulated on the model, and checked from the current position."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from rotemina.app.language import translate
from rotemina.app.motion.state import SessionState
from rotemina.app.records import LibraryEntry, read_commands
from rotemina.app.workbench.help_topics import get_message_page
from rotemina.app.workbench.job_runner import JobRunner
from rotemina.app.workbench.loaded_trajectory import TrajectoryPlan
from rotemina.app.workbench.notice_poster import Level, NoticePoster
from rotemina.app.workbench.operator_requests import OperatorRequests
from rotemina.app.workbench.requests_at_rest import WaitingRequest
from rotemina.drivers.contract import DeviceState
from rotemina.sim.messages import PlainText, join_messages
from rotemina.sim.records import Record, read_record


class TrajectoryPlanner(QObject):
    """Planner that simulates a trajectory on the model before it becomes the loaded one.

    Attributes
    ----------
    plan : TrajectoryPlan or None
        The loaded trajectory.
    planning : str
        Name of a trajectory whose dry run is in progress, or "".

    Signals
    -------
    replacing() : another trajectory is about to become the loaded one.
    plan_changed(TrajectoryPlan) : a trajectory was loaded and its dry run is done.
    plan_checked(TrajectoryPlan) : the same plan was checked again at another position of the
        machine.
    """

    replacing = Signal()
    plan_changed = Signal(object)
    plan_checked = Signal(object)

    def __init__(self, requests: OperatorRequests, jobs: JobRunner, notices: NoticePoster) -> None:
        super().__init__(requests)
        self.plan: TrajectoryPlan | None = None
        self.planning = ""
        self._session, self._robot = requests.session, requests.robot
        self._requests, self._jobs, self._notices = requests, jobs, notices
        # The plan, and what its check depended on, at the latest check.
        self._checked_inputs: tuple[object, ...] = ()

    def load_trajectory(self, path: Path, columns: str | None = None) -> None:
        """Read a trajectory and simulate it on the model; a failure leaves the plan unchanged."""
        self._start_plan(
            path.name,
            _describe_reading(path.name),
            lambda: read_record(path, columns=columns, robot=self._robot),
        )

    def load_entry(self, entry: LibraryEntry) -> None:
        """Load the commands of a library record as a trajectory."""
        self._start_plan(
            entry.name,
            _describe_reading(entry.name),
            lambda: read_commands(entry, self._robot, self._session.setpoint_period_s),
        )

    def plan_trajectory(self, name: str, trajectory: Record) -> None:
        """Simulate a trajectory on the model and load it."""
        self._start_plan(name, translate("shell", "Dry run …"), lambda: trajectory, renews=True)

    def plan_and_play(
        self,
        name: str,
        trajectory: Record,
        request: WaitingRequest,
        play: Callable[[TrajectoryPlan], object],
    ) -> None:
        """Load a trajectory and, if its dry run permits it, call ``play`` with the plan.

        The request waits until then; if it is withdrawn meanwhile, nothing is played.
        """

        def done(plan: TrajectoryPlan) -> None:
            self.take_plan(plan)
            if not plan.dry_run.allowed:
                # The reason was already reported when the plan was loaded.
                request.end_silently()
            elif request.is_waiting:
                play(plan)

        def withdraw_request() -> None:
            request.withdraw(translate("shell", "another trajectory was loaded meanwhile"))

        self._start_plan(
            name,
            translate("shell", "Dry run …"),
            lambda: trajectory,
            done,
            undone=request.end_silently,
            replaced=withdraw_request,
        )

    def plan_again(self, plan: TrajectoryPlan) -> None:
        """Simulate the loaded trajectory again, on another model or device."""
        self._jobs.work(
            "plan again",
            translate("shell", "Dry run …"),
            lambda: TrajectoryPlan.from_trajectory(self._session, plan.name, plan.trajectory),
            self._renew_plan,
            renews=True,
        )

    def take_plan(self, plan: TrajectoryPlan) -> None:
        """Make a simulated trajectory the loaded one."""
        self.replacing.emit()
        self._session.dismiss_stop()
        self.plan = plan
        self.plan_changed.emit(plan)
        self._report_objection(plan)

    def recheck_plan(self, state: SessionState) -> None:
        """Check the plan again if the machine rests elsewhere; to be called in every frame."""
        plan, session = self.plan, self._session
        if plan is None or state.activity is not DeviceState.IDLE or not state.command:
            return
        inputs = plan, session.path_check_basis
        if inputs[1] == plan.check_inputs or inputs == self._checked_inputs:
            return
        self._checked_inputs = inputs

        def done(checked: TrajectoryPlan) -> None:
            if self.plan is plan:
                self.plan = checked
                self.plan_checked.emit(checked)

        self._jobs.run_quietly(
            "plan from here", lambda: plan.check_again(session), done, self._requests.refused.emit
        )

    def _start_plan(
        self,
        name: str,
        activity: str,
        read: Callable[[], Record],
        done: Callable[[TrajectoryPlan], None] | None = None,
        *,
        undone: Callable[[], None] = lambda: None,
        replaced: Callable[[], None] | None = None,
        renews: bool = False,
    ) -> None:
        self.planning = name

        def work() -> TrajectoryPlan:
            return TrajectoryPlan.from_trajectory(self._session, name, read())

        def finish(plan: TrajectoryPlan) -> None:
            self.planning = ""
            (done or self.take_plan)(plan)

        def on_failed() -> None:
            self.planning = ""
            undone()

        self._jobs.work("plan", activity, work, finish, on_failed, replaced=replaced, renews=renews)

    def _report_objection(self, plan: TrajectoryPlan) -> None:
        """Show why a plan cannot be played, until another is loaded or this one can be played."""
        if not plan.objection:
            return

        def is_over(_: SessionState) -> bool:
            current_plan = self.plan
            return (
                current_plan is None
                or current_plan.trajectory is not plan.trajectory
                or not current_plan.objection
            )

        self._notices.notify(
            Level.WARNING,
            join_messages((PlainText(plan.name), plan.objection), ": "),
            about=get_message_page(plan.objection) or "trajectory.md",
            until=is_over,
        )

    def _renew_plan(self, plan: TrajectoryPlan) -> None:
        """Replace the plan by one with a new dry run; a paused playback stays paused."""
        if self.plan is None or self.plan.trajectory is not plan.trajectory:
            # Another trajectory was loaded meanwhile.
            return
        self.plan = plan
        self.plan_changed.emit(plan)


def _describe_reading(name: str) -> str:
    return translate("shell", "Reading {name} …").format(name=name)
