"""Procedures that move an axis by camera pictures: one at a time, ended when not trustworthy."""

import threading
from collections.abc import Callable
from typing import Protocol

from rotemina.app.cameras.feed import FeedState, FeedView
from rotemina.app.microscope.errors import MicroscopeError
from rotemina.app.microscope.status import Activity
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.stop import PROGRAM
from rotemina.sim.messages import message

_BROKEN = (
    FeedState.CLOSED,
    FeedState.STALLED,
    FeedState.FROZEN,
    FeedState.BLACK,
    FeedState.LOST,
)


class Run(Protocol):
    """A calibration, a click or an autofocus."""

    @property
    def ended(self) -> bool:
        """Whether the run has ended."""

    def step(self, now_s: float) -> object:
        """Advance; never raises for what a device or a camera does."""

    def abort(self, reason: str) -> None:
        """Stop the machine and end."""


class Runs:
    """The one run; begun and stopped from any thread, stepped by one.

    Parameters
    ----------
    session : MotionSession
    feed : callable
        Return how the camera is doing.
    doubt : callable
        Return why the picture of the tip must not be moved by, or nothing.
    """

    def __init__(
        self,
        session: MotionSession,
        feed: Callable[[], FeedView],
        doubt: Callable[[Activity], str] = lambda _: "",
    ) -> None:
        self._session, self._feed, self._doubt = session, feed, doubt
        self._lock = threading.Lock()  # guards what follows; never held while anybody waits
        self._run: Run | None = None
        self._after: Callable[[], None] = lambda: None
        self._activity = Activity.NONE
        self._asked = ""
        #: Why the latest run was ended from here; empty if it was not.
        self.stopped = ""

    @property
    def activity(self) -> Activity:
        """The running activity."""
        return self._activity

    def begin(
        self,
        activity: Activity,
        make: Callable[[], Run],
        after: Callable[[], None] = lambda: None,
    ) -> None:
        """Begin a run, which may move at once; ``after`` is called when it has ended.

        Raises
        ------
        InputError
            If another is under way, the camera shows nothing that can be trusted, or as ``make``.
        """
        view = self._feed()
        if view.state in _BROKEN or view.frame is None:
            raise MicroscopeError(
                message("engine", "{trouble}; nothing moves").fill(trouble=_trouble(view))
            )
        with self._lock:
            if self._run is not None:
                raise MicroscopeError(
                    message("engine", "a {activity} is under way; wait, or stop it first").fill(
                        activity=self._activity
                    )
                )
            self._asked = self.stopped = ""
            self._run, self._after = make(), after
            self._activity = activity

    def stop(self, reason: str, *, by: str = PROGRAM) -> None:
        """Halt the machine, and end what is under way; ``by`` as of :meth:`MotionSession.stop`."""
        with self._lock:
            if self._run is None:
                return
            self._asked = reason
        self._session.stop(reason, by=by)

    def step(self, now_s: float) -> None:
        """Advance; on one thread only."""
        with self._lock:
            run, asked, activity = self._run, self._asked, self._activity
        if run is None:
            return
        reason = asked or self._reason(activity)
        if reason:
            self.stopped = reason
            run.abort(reason)
        else:
            run.step(now_s)
        if run.ended:
            self._after()
            with self._lock:
                self._run, self._activity = None, Activity.NONE

    def _reason(self, activity: Activity) -> str:
        view = self._feed()
        return _trouble(view) if view.state in _BROKEN else self._doubt(activity)


def _trouble(view: FeedView) -> str:
    if view.state is FeedState.CLOSED or view.frame is None:
        return message("engine", "there is no picture; open a camera and wait for the first one")
    return message("engine", "the camera is {state}: {reason}").fill(
        state=view.state, reason=view.reason
    )
