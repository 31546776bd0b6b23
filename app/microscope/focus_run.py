"""Autofocus: moves a drive, evaluates pictures, and ends at the sharpest position.

What moves is the microscope's focus drive or an axis of the machine, such as z through the
session, which knows its limits.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import StrEnum

from rotemina.app.microscope.settled_frame import Newest, SettledFrameGrabber
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.gate import Permit
from rotemina.sim.errors import InputError
from rotemina.sim.vision.autofocus import Autofocus, FocusPeak, sharpness


class Search(StrEnum):
    """Where an autofocus is."""

    UNDER_WAY = "under way"
    DONE = "done"
    FAILED = "failed"


@dataclass(frozen=True, slots=True)
class FocusStatus:
    """Status for display: the pictures so far, and the peak or the reason for none."""

    search: Search
    places: tuple[float, ...] = ()
    values: tuple[float, ...] = ()
    peak: FocusPeak | None = None
    reason: str = ""


class FocusRun:
    """Brings something into focus; someone calls :meth:`step`.

    Parameters
    ----------
    session : MotionSession
    newest : callable
        The camera's newest picture.
    move : callable
        Goes to a focus place, m, with a permit; raises InputError if it must not.
    low, high : float
        Where to search, m, in the terms of ``move``.
    now_s : float
    part : (slice, slice), optional
        Rows and columns that are to be sharp; all of them by default.

    Raises
    ------
    InputError
        If that is no range, or the first move is refused.
    """

    def __init__(
        self,
        session: MotionSession,
        newest: Newest,
        move: Callable[[float, Permit | None], None],
        low: float,
        high: float,
        *,
        now_s: float,
        part: tuple[slice, slice] = (slice(None), slice(None)),
    ) -> None:
        self._session, self._move, self._part = session, move, part
        self._autofocus = Autofocus.between(low, high)
        self._looking = SettledFrameGrabber(session, newest)
        self.status = FocusStatus(Search.UNDER_WAY)
        self._go(now_s)

    def step(self, now_s: float) -> FocusStatus:
        """Advance; never raises for what a device or a camera does."""
        if self.ended:
            return self.status
        try:
            look = self._looking.step(now_s)
            if look is None:
                return self.status
            if self._autofocus.done:
                peak = self._autofocus.peak
                self.status = replace(self.status, search=Search.DONE, peak=peak)
                return self.status
            self._autofocus = self._autofocus.with_sharpness(sharpness(look.image[self._part]))
            found = self._autofocus
            self.status = replace(self.status, places=found.places, values=found.values)
            self._looking.check()
            self._go(now_s)
        except InputError as error:
            self.status = replace(self.status, search=Search.FAILED, reason=str(error))
        return self.status

    @property
    def ended(self) -> bool:
        """Whether the run has ended."""
        return self.status.search is not Search.UNDER_WAY

    def abort(self, reason: str) -> None:
        """Stop the machine and end; it stays where it is."""
        if not self.ended:
            self._session.stop(reason)
            self.status = replace(self.status, search=Search.FAILED, reason=reason)

    def _go(self, now_s: float) -> None:
        target = self._autofocus.target
        assert target is not None
        self._move(target, self._looking.permit)
        self._looking.begin(now_s)
