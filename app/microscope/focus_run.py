"""Autofocus: moves a drive, evaluates pictures, and ends at the sharpest position.

The drive is the microscope's focus drive, or an axis of the machine such as z. An axis is moved
through the session, which checks its limits.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import StrEnum

from rotemina.app.microscope.settled_frame import FrameSource, SettledFrameGrabber
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.contract import Permit
from rotemina.sim.errors import InputError
from rotemina.sim.vision import (
    AutofocusSearch,
    FocusPeak,
    measure_sharpness,
)


class MicroscopeRunState(StrEnum):
    """State of an autofocus or a z-stack."""

    UNDER_WAY = "under way"
    DONE = "done"
    FAILED = "failed"


@dataclass(frozen=True, slots=True)
class FocusStatus:
    """Status of an autofocus, for display.

    ``sharpness_values`` belong to the pictures at ``positions``, m. At the end either ``peak`` is
    set, or ``reason`` says why the run failed.
    """

    state: MicroscopeRunState
    positions: tuple[float, ...] = ()
    sharpness_values: tuple[float, ...] = ()
    peak: FocusPeak | None = None
    reason: str = ""


class FocusRun:
    """An autofocus run; its owner calls :meth:`step`.

    Parameters
    ----------
    session : MotionSession
    newest_frame : callable
        Returns the camera's newest picture.
    move : callable
        Moves to a focus position, m, with a permit; raises InputError if the move is refused.
    low, high : float
        Ends of the search, m, as positions for ``move``.
    now_s : float
        Host time.
    window : (slice, slice), optional
        Rows and columns in which sharpness is measured; by default the whole picture.

    Raises
    ------
    InputError
        If the range is invalid, or the first move is refused.
    """

    def __init__(
        self,
        session: MotionSession,
        newest_frame: FrameSource,
        move: Callable[[float, Permit | None], None],
        low: float,
        high: float,
        *,
        now_s: float,
        window: tuple[slice, slice] = (slice(None), slice(None)),
    ) -> None:
        self._session, self._move, self._window = session, move, window
        self._autofocus = AutofocusSearch.between(low, high)
        self._grabber = SettledFrameGrabber(session, newest_frame)
        self.status = FocusStatus(MicroscopeRunState.UNDER_WAY)
        self._start_next_move(now_s)

    def step(self, now_s: float) -> FocusStatus:
        """Advance the run; a failure of a device or a camera ends the run and raises nothing."""
        if self.ended:
            return self.status
        try:
            settled = self._grabber.step(now_s)
            if settled is None:
                return self.status
            if self._autofocus.is_done:
                peak = self._autofocus.peak
                self.status = replace(self.status, state=MicroscopeRunState.DONE, peak=peak)
                return self.status
            self._autofocus = self._autofocus.with_sharpness(
                measure_sharpness(settled.image[self._window])
            )
            autofocus = self._autofocus
            self.status = replace(
                self.status, positions=autofocus.places, sharpness_values=autofocus.values
            )
            self._grabber.require_motion_permitted()
            self._start_next_move(now_s)
        except InputError as error:
            self.status = replace(self.status, state=MicroscopeRunState.FAILED, reason=str(error))
        return self.status

    @property
    def ended(self) -> bool:
        """Whether the run has ended."""
        return self.status.state is not MicroscopeRunState.UNDER_WAY

    def abort(self, reason: str) -> None:
        """Stop the machine, which stays where it is, and end the run."""
        if not self.ended:
            self._session.stop(reason)
            self.status = replace(self.status, state=MicroscopeRunState.FAILED, reason=reason)

    def _start_next_move(self, now_s: float) -> None:
        target = self._autofocus.target
        assert target is not None
        self._move(target, self._grabber.permit)
        self._grabber.begin(now_s)
