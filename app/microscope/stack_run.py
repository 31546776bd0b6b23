"""A z-stack: pictures at equidistant positions of the focus drive or an axis.

Each picture is taken after the machine has come to rest, as for autofocus. At the end the drive or
axis returns to its start position. A stop ends the stack, and the machine stays where it is. Once
all pictures are taken, only :meth:`StackRun.abort` discards them; a failed return does not.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import floor, isfinite

import numpy as np

from rotemina.app.cameras import StackPage
from rotemina.app.errors import MicroscopeError
from rotemina.app.microscope.focus_run import MicroscopeRunState
from rotemina.app.microscope.settled_frame import FrameSource, SettledFrameGrabber
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.contract import Permit
from rotemina.sim.errors import InputError
from rotemina.sim.messages import format_fixed, message
from rotemina.sim.units import format_exact

MAX_PAGES = 1000
# Largest total size of the pictures, which stay in memory until they are written.
MAX_STACK_BYTES = 1 << 29
# Because of rounding, the last position may lie beyond the end by this fraction of a step.
_STEP_TOLERANCE_RATIO = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class StackStatus:
    """Status of a z-stack, for display.

    ``axis`` is ``focus`` or the axis of the machine that moves. ``done`` and ``total`` are numbers
    of pictures. ``pages`` are set at the end of a completed stack. ``reason`` says why the stack
    failed or, if it is completed, why the return to the start position failed; else it is empty.
    """

    state: MicroscopeRunState
    axis: str
    done: int
    total: int
    pages: tuple[StackPage, ...] = ()
    reason: str = ""


def compute_stack_positions(first: float, last: float, step: float) -> tuple[float, ...]:
    """Compute equidistant positions, m, from ``first`` towards ``last`` and not beyond it.

    Raises
    ------
    MicroscopeError
        If the step is not above zero, or there would be too many positions.
    """
    length = abs(last - first)
    if not (isfinite(length) and isfinite(step) and step > 0.0):
        raise MicroscopeError(
            "z-stack: step {step}: must be above 0 µm", step=format_exact(step, "m")
        )
    count = floor(length / step + _STEP_TOLERANCE_RATIO) + 1
    if count > MAX_PAGES:
        raise MicroscopeError(
            "z-stack: {count} pictures: must be at most {most}; use a larger step",
            count=count,
            most=MAX_PAGES,
        )
    signed_step = np.copysign(step, last - first)
    return tuple((first + signed_step * np.arange(count)).tolist())


class StackRun:
    """A run that takes a z-stack; its owner calls :meth:`step`.

    Parameters
    ----------
    session : MotionSession
    newest_frame : callable
        Returns the camera's newest picture.
    move : callable
        Moves to a focus position, m, with a permit; raises InputError if the move is refused.
    axis : str
        Name of the axis that ``move`` moves.
    positions : tuple of float
        Positions of the pictures, m.
    return_position : float
        Position to which the axis returns at the end, m.
    now_s : float
        Host time.

    Raises
    ------
    InputError
        If there is no picture yet, the pictures would be too large, or the first move is refused.
    """

    def __init__(
        self,
        session: MotionSession,
        newest_frame: FrameSource,
        move: Callable[[float, Permit | None], None],
        axis: str,
        positions: tuple[float, ...],
        return_position: float,
        *,
        now_s: float,
    ) -> None:
        self._session, self._newest_frame, self._move = session, newest_frame, move
        self._positions = (*positions, return_position)
        self._pages: list[StackPage] = []
        self._check_size(len(positions))
        self._grabber = SettledFrameGrabber(session, newest_frame, pictures=1)
        self.status = StackStatus(MicroscopeRunState.UNDER_WAY, axis, 0, len(positions))
        self._start_next_move(now_s)

    def step(self, now_s: float) -> StackStatus:
        """Advance the run; a failure of a device or a camera ends the run and raises nothing."""
        if self.ended:
            return self.status
        try:
            if self._grabber.step(now_s) is None:
                return self.status
            if self._has_all_pages:
                self._complete("")
                return self.status
            self._store_page()
            self._grabber.require_motion_permitted()
            self._start_next_move(now_s)
        except InputError as error:
            if self._has_all_pages:
                text = message("engine", "the return to the start position failed: {error}")
                self._complete(text.fill(error=str(error)))
            else:
                self.status = replace(
                    self.status, state=MicroscopeRunState.FAILED, reason=str(error)
                )
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

    @property
    def _has_all_pages(self) -> bool:
        return len(self._pages) == self.status.total

    def _complete(self, reason: str) -> None:
        self.status = replace(
            self.status, state=MicroscopeRunState.DONE, pages=tuple(self._pages), reason=reason
        )

    def _store_page(self) -> None:
        frame, state = self._newest_frame(), self._session.snapshot()
        assert frame is not None, "a settled picture has just arrived"
        position = self._positions[len(self._pages)]
        self._pages.append(StackPage(position, frame, dict(state.command), dict(state.measured)))
        self.status = replace(self.status, done=len(self._pages))

    def _start_next_move(self, now_s: float) -> None:
        self._move(self._positions[len(self._pages)], self._grabber.permit)
        self._grabber.begin(now_s)

    def _check_size(self, count: int) -> None:
        frame = self._newest_frame()
        if frame is None:
            raise MicroscopeError("z-stack: there is no picture; open a camera")
        size = count * frame.pixels.nbytes
        if size > MAX_STACK_BYTES:
            raise MicroscopeError(
                "z-stack: {count} pictures of {each} MB: must be at most {most} MB "
                "together; use a larger step, or a part of the sensor",
                count=count,
                each=format_fixed(frame.pixels.nbytes / 1e6, 1),
                most=format_fixed(MAX_STACK_BYTES / 1e6, 0),
            )
