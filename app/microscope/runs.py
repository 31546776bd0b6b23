"""Execution of runs that move axes guided by camera pictures, one run at a time.

A run ends as soon as its pictures cannot be trusted.
"""

import threading
from collections.abc import Callable
from typing import Protocol

from rotemina.app.cameras import FeedState, FeedView
from rotemina.app.errors import MicroscopeError
from rotemina.app.microscope.status import MicroscopeActivity
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import PROGRAM
from rotemina.sim.messages import message

_UNTRUSTED_STATES = (
    FeedState.CLOSED,
    FeedState.STALLED,
    FeedState.FROZEN,
    FeedState.BLACK,
    FeedState.LOST,
)


class MicroscopeRun(Protocol):
    """A run, such as a calibration, a click, an autofocus or a z-stack."""

    @property
    def ended(self) -> bool:
        """Whether the run has ended."""

    def step(self, now_s: float) -> object:
        """Advance the run; a failure of a device or a camera ends the run and raises nothing."""

    def abort(self, reason: str) -> None:
        """Stop the machine and end the run."""


class MicroscopeRunner:
    """Executes at most one run. Any thread may start or stop it; only one thread may step it.

    Parameters
    ----------
    session : MotionSession
    read_feed : callable
        Returns the state of the camera.
    find_tracking_problem : callable
        Returns why the tracked tip must not guide this activity, or an empty text.
    """

    def __init__(
        self,
        session: MotionSession,
        read_feed: Callable[[], FeedView],
        find_tracking_problem: Callable[[MicroscopeActivity], str] = lambda _: "",
    ) -> None:
        self._session, self._read_feed, self._find_tracking_problem = (
            session,
            read_feed,
            find_tracking_problem,
        )
        # Guards the attributes below; never held during a wait.
        self._lock = threading.Lock()
        self._run: MicroscopeRun | None = None
        self._on_ended: Callable[[], None] = lambda: None
        self._activity = MicroscopeActivity.NONE
        self._stop_reason = ""
        #: Why the latest run was aborted; empty if it was not.
        self.abort_reason = ""

    @property
    def activity(self) -> MicroscopeActivity:
        """The current activity."""
        return self._activity

    def begin(
        self,
        activity: MicroscopeActivity,
        make_run: Callable[[], MicroscopeRun],
        on_ended: Callable[[], None] = lambda: None,
    ) -> None:
        """Start a run, which may move at once; ``on_ended`` is called after its end.

        Raises
        ------
        InputError
            If another run is under way, the camera's picture cannot be trusted, or ``make_run``
            raises an InputError.
        """
        view = self._read_feed()
        if view.state in _UNTRUSTED_STATES or view.frame is None:
            raise MicroscopeError(
                "{trouble}; no move was started", trouble=_describe_camera_problem(view)
            )
        with self._lock:
            if self._run is not None:
                raise MicroscopeError(
                    "{activity} is under way; wait, or stop it first", activity=self._activity
                )
            self._stop_reason = self.abort_reason = ""
            self._run, self._on_ended = make_run(), on_ended
            self._activity = activity

    def stop(self, reason: str, *, by: str = PROGRAM) -> None:
        """Halt the machine, and end the current run; ``by`` as in :meth:`MotionSession.stop`."""
        with self._lock:
            if self._run is None:
                return
            self._stop_reason = reason
        self._session.stop(reason, by=by)

    def step(self, now_s: float) -> None:
        """Advance the run; call this on one thread only."""
        with self._lock:
            run, stop_reason, activity = self._run, self._stop_reason, self._activity
        if run is None:
            return
        reason = stop_reason or self._find_abort_reason(activity)
        if reason:
            self.abort_reason = reason
            run.abort(reason)
        else:
            run.step(now_s)
        if run.ended:
            self._on_ended()
            with self._lock:
                self._run, self._activity = None, MicroscopeActivity.NONE

    def _find_abort_reason(self, activity: MicroscopeActivity) -> str:
        view = self._read_feed()
        return (
            _describe_camera_problem(view)
            if view.state in _UNTRUSTED_STATES
            else self._find_tracking_problem(activity)
        )


def _describe_camera_problem(view: FeedView) -> str:
    if view.state is FeedState.CLOSED or view.frame is None:
        return message(
            "engine", "there is no picture; open a camera and wait for its first picture"
        )
    return message("engine", "the camera is {state}: {reason}").fill(
        state=view.state, reason=view.reason
    )
