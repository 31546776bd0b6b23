"""Resumption of a paused playback: wait for rest, move axes back if requested, continue."""

from collections.abc import Callable, Iterator
from enum import StrEnum

from rotemina.app.motion.playback.playback import NOT_RESUMED, Playback, PlaybackPhase
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.contract import Permit
from rotemina.sim.errors import InputError


class ResumeStep(StrEnum):
    """The step that a resumption waits for."""

    NONE = "none"
    RESTING = "resting"
    RETURNING = "returning"
    CHECKING = "checking"


class PlaybackResumption:
    """Resumes a playback step by step; :meth:`step` is called periodically, on one thread.

    One permit, taken with the request, covers all steps. A stop at any step ends the resumption,
    and the operator is notified that nothing was resumed.

    Parameters
    ----------
    session : MotionSession
    playback : Playback
    ask : callable
        Called for the final request with three functions. It runs the first one, which checks a
        path and may take seconds, and then calls the second one. If the request is refused, it
        reports the refusal and calls the third one instead.
    on_refused : callable
        Called with the reason if the playback is not resumed.
    """

    def __init__(
        self,
        session: MotionSession,
        playback: Playback,
        ask: Callable[[Callable[[], object], Callable[[], None], Callable[[], None]], object],
        on_refused: Callable[[str], object],
    ) -> None:
        self._session, self._playback = session, playback
        self._ask, self._on_refused = ask, on_refused
        self._permit = session.permit()
        self._steps: Iterator[ResumeStep] | None = None
        #: The step that the resumption waits for now.
        self.waits_for = ResumeStep.NONE

    def begin(
        self, permit: Permit, *, speed: float | None = None, moves_back: bool = False
    ) -> None:
        """Resume as soon as the machine rests; with ``moves_back``, move its axes back first.

        ``permit`` and ``speed`` have the same meaning as in :meth:`Playback.resume`. Does nothing
        while a resumption is running.
        """
        if self._steps is None:
            self._permit = permit
            self._steps = self._resume(permit, speed, moves_back=moves_back)
            self.step()

    def step(self) -> None:
        """Execute the steps that are possible now."""
        if self._steps is None or self.waits_for is ResumeStep.CHECKING:
            return
        if self._playback.state.phase is not PlaybackPhase.PAUSED:
            # Meanwhile the playback has been ended or started again.
            self._end()
        elif not self._permit.is_valid:
            self._end()
            self._on_refused(NOT_RESUMED)
        else:
            self._advance(self._steps)

    def _advance(self, steps: Iterator[ResumeStep]) -> None:
        try:
            step = next(steps)
        except InputError as error:
            self._end()
            self._on_refused(str(error))
        else:
            if self._steps is not None:
                self.waits_for = step

    def _end(self) -> None:
        self._steps, self.waits_for = None, ResumeStep.NONE

    def _resume(
        self, permit: Permit, speed: float | None, *, moves_back: bool
    ) -> Iterator[ResumeStep]:
        while not self._session.at_rest:
            yield ResumeStep.RESTING
        if moves_back:
            self._playback.move_back(permit=permit)
            while not self._session.at_rest:
                yield ResumeStep.RETURNING
        self._ask(lambda: self._playback.resume(speed=speed, permit=permit), self._end, self._end)
        yield ResumeStep.CHECKING
