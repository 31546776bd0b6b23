"""Playing the loaded trajectory: play, pause, resume, step and end."""

from collections.abc import Callable

from PySide6.QtCore import QMetaMethod, QObject, Signal

from rotemina.app.language import marked, translate
from rotemina.app.motion.device import OPERATOR
from rotemina.app.motion.playback import (
    Playback,
    PlaybackPhase,
    PlaybackResumption,
    PlaybackState,
    ResumeStep,
)
from rotemina.app.motion.state import SessionState
from rotemina.app.workbench.loaded_trajectory import TrajectoryPlan
from rotemina.app.workbench.notice_poster import Level, NoticePoster
from rotemina.app.workbench.operator_requests import OperatorRequests
from rotemina.app.workbench.requests_at_rest import AtRestScheduler, WaitingRequest
from rotemina.app.workbench.steady_meaning import ButtonMeaning
from rotemina.app.workbench.trajectory_planner import TrajectoryPlanner
from rotemina.drivers.contract import Permit

#: Reported when a request to play is withdrawn before it had an effect.
NOT_PLAYED = marked("shell", "Not played: {why}. Press Play again.")


class PlaybackController(QObject):
    """Controller of the playback of the loaded trajectory, as the operator requests it.

    Attributes
    ----------
    playback : Playback
    resumption : PlaybackResumption
    pace : float
        Speed of the next playback as a multiple of the trajectory's own.
    bounds : dict of str to float
        Largest permitted deviation of readings from the model in the next playback, by axis, in m
        or rad.
    play_meaning : ButtonMeaning
        The current meaning of the play button.

    Signals
    -------
    speed_limit_asked(TrajectoryPlan, callable, WaitingRequest) : the callable plays the plan, but
        nothing limits the speed of an axis; the request waits for the operator's answer.
    resume_asked(bool) : axes were moved during the pause and the operator must choose how to
        continue; False if the question has become obsolete.
    """

    speed_limit_asked = Signal(object, object, object)
    resume_asked = Signal(bool)
    _exceeded = Signal(object)

    def __init__(
        self,
        requests: OperatorRequests,
        planner: TrajectoryPlanner,
        at_rest: AtRestScheduler,
        notices: NoticePoster,
    ) -> None:
        super().__init__(requests)
        self.pace = 1.0
        self.bounds: dict[str, float] = {}
        self._session, self._requests = requests.session, requests
        self._planner, self._at_rest, self._notices = planner, at_rest, notices
        self._exceeded.connect(self._report_excess)
        self.playback = Playback(requests.session, self._exceeded.emit)
        self.resumption = PlaybackResumption(
            requests.session, self.playback, requests.ask_in_background, requests.refused.emit
        )
        self.play_meaning = ButtonMeaning(meaning=PlaybackPhase.IDLE)
        planner.replacing.connect(self._end_paused_playback)

    @property
    def phase(self) -> PlaybackPhase:
        """Phase of the playback."""
        return self.playback.state.phase

    def close(self) -> None:
        """Detach from the session; a running playback continues."""
        self.playback.close()

    def play(self, permit: Permit | None = None) -> None:
        """Play the loaded trajectory; a refusal becomes a notice.

        If the request has waited, pass its ``permit``: after a stop in the meantime, nothing is
        played, and that is reported. If the machine is about to rest, playing waits for that.
        """
        plan = self._planner.plan
        request = WaitingRequest(self._requests, translate("shell", NOT_PLAYED), permit)
        if self._planner.planning:
            text = translate("shell", "the dry run of {name} has not ended yet")
            request.withdraw(text.format(name=self._planner.planning))
        elif plan is None:
            text = translate("shell", "There is no trajectory to play: load one first.")
            self._notices.notify(
                Level.WARNING,
                text,
                about="trajectory.md",
                until=lambda _: self._planner.plan is not None,
            )
        elif self._requests.run_request(plan.dry_run.require):
            checked, pace, bounds = plan.dry_run.require(), self.pace, dict(self.bounds)
            self._at_rest.do(
                request,
                lambda: self.playback.play(
                    checked, speed=pace, bounds=bounds, permit=request.permit
                ),
            )

    def find_toggle_objection(self, state: PlaybackState) -> str | None:
        """Return why a press on play, pause or resume is ignored now, or None if it is accepted."""
        if self.resumption.waits_for is not ResumeStep.NONE:
            return translate("shell", "the playback is being resumed")
        if state.pausing:
            return translate("shell", "the axes are still moving")
        if not self.play_meaning.is_settled(state.phase):
            return translate("shell", "the button has only just changed")
        return None

    def toggle_playback(self) -> None:
        """Play, pause or resume, depending on what the button showed when it was pressed."""
        state = self.playback.state
        if (reason := self.find_toggle_objection(state)) is not None:
            text = translate("shell", "Not done: {why}.").format(why=reason)
            self._notices.notify(Level.INFO, text, about="motion.md#playing-by-hand")
        elif state.phase is PlaybackPhase.PLAYING:
            self._requests.run_request(lambda: self.playback.pause(by=OPERATOR))
        elif state.phase is PlaybackPhase.IDLE:
            self.play_with_speed_limit(self._planner.plan, self.play)
        elif state.moved:
            self.resume_asked.emit(True)
        else:
            self.resume_playback(moves_back=False)

    def resume_playback(self, *, moves_back: bool) -> None:
        """Resume when the machine rests; with ``moves_back``, after its axes have returned."""
        self.resumption.begin(self._session.permit(), speed=self.pace, moves_back=moves_back)

    def start_playback_over(self) -> None:
        """Play the paused trajectory again from its first row."""
        permit, pace = self._session.permit(), self.pace
        self._requests.ask_in_background(
            lambda: self.playback.start_over(speed=pace, permit=permit)
        )

    def play_with_speed_limit(
        self,
        plan: TrajectoryPlan | None,
        play: Callable[[], object],
        request: WaitingRequest | None = None,
    ) -> None:
        """Call ``play``; if the speed of an axis is unlimited, ask the operator for a limit first.

        ``request`` is the request that waits for the answer, if there is one already.
        """
        checked = None if plan is None else plan.dry_run.checked
        if checked is None or not self.playback.axes_without_speed_limit(checked):
            play()
        elif self.isSignalConnected(QMetaMethod.fromSignal(self.speed_limit_asked)):
            waiting_request = request or WaitingRequest(
                self._requests, translate("shell", NOT_PLAYED)
            )
            self.speed_limit_asked.emit(plan, play, waiting_request)
        else:
            text = translate(
                "shell",
                "Not played: nothing limits the speed of an axis, and the panel Trajectory, which "
                "asks for a limit, is missing. State a limit in the robot file.",
            )
            self._notices.notify(Level.ERROR, text, about="trajectory.md")

    def step_playback(self, rows: int) -> None:
        """Move forward or back by some rows and rest there."""

        def step() -> None:
            if self.playback.state.phase is PlaybackPhase.IDLE and self._planner.plan is not None:
                self.playback.load_paused(self._planner.plan.dry_run.require())
            self.playback.step(rows)

        self._requests.run_request(step)

    def end_playback(self) -> None:
        """Stop the playback; the next one starts from the beginning."""
        self.playback.end(by=OPERATOR)

    def follow_playback(self) -> None:
        """Continue a resumption, and withdraw an obsolete question; to be called in every frame."""
        self.resumption.step()
        playback = self.playback.state
        self.play_meaning.set_meaning(playback.phase)
        # A moving axis may come back or move farther, so the question stays until it rests.
        if playback.phase is not PlaybackPhase.PAUSED or (
            self._session.at_rest and not playback.moved
        ):
            self.resume_asked.emit(False)

    def _end_paused_playback(self) -> None:
        if self.phase is PlaybackPhase.PAUSED:
            # The paused trajectory is no longer the loaded one.
            self.playback.end()

    def _report_excess(self, excess: str) -> None:
        self._notices.notify(
            Level.ERROR,
            translate(
                "shell",
                "Playback paused: {text}. Check the machine, then resume or end the playback.",
            ).format(text=excess),
            about="motion.md#playing-by-hand",
            until=self._is_excess_over,
        )

    def _is_excess_over(self, _: SessionState) -> bool:
        state = self.playback.state
        return state.phase is PlaybackPhase.IDLE or not state.excess
