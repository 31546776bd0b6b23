"""A z-stack: pictures at equidistant positions of the focus drive or an axis, and the return.

Each is taken once the machine rests, as for autofocus; a stop ends it where it is.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import floor, isfinite

import numpy as np

from rotemina.app.cameras.snapshot import Page
from rotemina.app.microscope.errors import MicroscopeError
from rotemina.app.microscope.focus_run import Search
from rotemina.app.microscope.settled_frame import Newest, SettledFrameGrabber
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.gate import Permit
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.quantities import exact, fixed

MOST_PAGES = 1000
MOST_BYTES = 1 << 29  # of pictures that are kept until they are written
_WHOLE = 1e-6  # of a step, by which the last place may miss a whole number of them


@dataclass(frozen=True, slots=True, eq=False)
class StackStatus:
    """How far a stack is; ``pages`` are there when it is done.

    ``axis`` is what moves: ``focus`` or an axis of the machine.
    """

    search: Search
    axis: str
    done: int
    total: int
    pages: tuple[Page, ...] = ()
    reason: str = ""


def places_of(first: float, last: float, step: float) -> tuple[float, ...]:
    """Return even places from ``first`` towards ``last``, m, none beyond it.

    Raises
    ------
    MicroscopeError
        If the step is none, or there would be too many places.
    """
    length = abs(last - first)
    if not (isfinite(length) and isfinite(step) and step > 0.0):
        raise MicroscopeError(
            message("engine", "z-stack: step {step}: must be above 0 µm").fill(
                step=exact(step, "m")
            )
        )
    count = floor(length / step + _WHOLE) + 1
    if count > MOST_PAGES:
        raise MicroscopeError(
            message(
                "engine", "z-stack: {count} pictures: must be at most {most}; use a larger step"
            ).fill(count=count, most=MOST_PAGES)
        )
    away = np.copysign(step, last - first)
    return tuple((first + away * np.arange(count)).tolist())


class StackRun:
    """Takes the pictures; the caller calls :meth:`step`.

    Parameters
    ----------
    session : MotionSession
    newest : callable
        The camera's newest picture.
    move : callable
        Goes to a focus place, m, with a permit; raises InputError if it must not.
    axis : str
        What it moves, as it is to be called.
    places : tuple of float
        m, in the terms of ``move``.
    begin : float
        Where it goes back to.
    now_s : float

    Raises
    ------
    InputError
        If there is no picture, the pictures would be too many, or the first move is refused.
    """

    def __init__(
        self,
        session: MotionSession,
        newest: Newest,
        move: Callable[[float, Permit | None], None],
        axis: str,
        places: tuple[float, ...],
        begin: float,
        *,
        now_s: float,
    ) -> None:
        self._session, self._newest, self._move = session, newest, move
        self._ways = (*places, begin)
        self._pages: list[Page] = []
        self._check_size(len(places))
        self._looking = SettledFrameGrabber(session, newest, pictures=1)
        self.status = StackStatus(Search.UNDER_WAY, axis, 0, len(places))
        self._go(now_s)

    def step(self, now_s: float) -> StackStatus:
        """Advance; never raises for what a device or a camera does."""
        if self.ended:
            return self.status
        try:
            if self._looking.step(now_s) is None:
                return self.status
            if len(self._pages) == self.status.total:
                pages = tuple(self._pages)
                self.status = replace(self.status, search=Search.DONE, pages=pages)
                return self.status
            self._keep()
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

    def _keep(self) -> None:
        frame, state = self._newest(), self._session.snapshot()
        assert frame is not None, "the machine was just looked at"
        place = self._ways[len(self._pages)]
        self._pages.append(Page(place, frame, dict(state.command), dict(state.measured)))
        self.status = replace(self.status, done=len(self._pages))

    def _go(self, now_s: float) -> None:
        self._move(self._ways[len(self._pages)], self._looking.permit)
        self._looking.begin(now_s)

    def _check_size(self, count: int) -> None:
        frame = self._newest()
        if frame is None:
            raise MicroscopeError(message("engine", "z-stack: there is no picture; open a camera"))
        size = count * frame.pixels.nbytes
        if size > MOST_BYTES:
            raise MicroscopeError(
                message(
                    "engine",
                    "z-stack: {count} pictures of {each} MB: must be at most {most} MB "
                    "together; use a larger step, or a part of the sensor",
                ).fill(
                    count=count,
                    each=fixed(frame.pixels.nbytes / 1e6, 1),
                    most=fixed(MOST_BYTES / 1e6, 0),
                )
            )
