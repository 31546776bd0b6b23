"""Resuming a paused playback: wait for rest, move axes back if asked, then go on."""

from collections.abc import Callable, Iterator
from enum import StrEnum

from rotemina.app.motion.playback import NOT_RESUMED, Playback, PlaybackPhase
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.gate import Permit
from rotemina.sim.errors import InputError


class ResumeStep(StrEnum):
    """What a playback that is to be resumed waits for."""

    NONE = "none"
    RESTING = "resting"
    RETURNING = "returning"
    CHECKING = "checking"


class Resumption:
    """Resumes a playback step by step; :meth:`step` is called again and again, on one thread.

    One permit, drawn with the request, goes with all of it: a stop ends it at any step, and says
    that nothing was resumed.

    Parameters
    ----------
    session : MotionSession
    playback : Playback
    ask : callable
        Makes the last request, which checks a path and may take seconds, then calls the second of
        its arguments; the third if that was refused, which it tells itself.
    refused : callable
        Called with the reason why the playback was not resumed.
    """

    def __init__(
        self,
        session: MotionSession,
        playback: Playback,
        ask: Callable[[Callable[[], object], Callable[[], None], Callable[[], None]], object],
        refused: Callable[[str], object],
    ) -> None:
        self._session, self._playback = session, playback
        self._ask, self._refused = ask, refused
        self._permit = session.permit()
        self._steps: Iterator[ResumeStep] | None = None
        #: What it waits for now.
        self.waits_for = ResumeStep.NONE

    def begin(
        self, permit: Permit, *, speed: float | None = None, moves_back: bool = False
    ) -> None:
        """Resume as soon as the machine rests; with ``moves_back`` after its axes have returned.

        ``permit`` and ``speed`` as of :meth:`Playback.resume`. A resumption that is under way
        continues, and this does nothing.
        """
        if self._steps is None:
            self._permit = permit
            self._steps = self._resume(permit, speed, moves_back=moves_back)
            self.step()

    def step(self) -> None:
        """Do what can be done now."""
        if self._steps is None or self.waits_for is ResumeStep.CHECKING:
            return
        if self._playback.state.phase is not PlaybackPhase.PAUSED:
            self._end()  # it was ended, or played anew
        elif not self._permit.valid:
            self._end()
            self._refused(NOT_RESUMED)
        else:
            self._advance(self._steps)

    def _advance(self, steps: Iterator[ResumeStep]) -> None:
        try:
            step = next(steps)
        except InputError as error:
            self._end()
            self._refused(str(error))
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
