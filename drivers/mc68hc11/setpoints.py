"""The window of set-points on their way to one board: several at once, in order, none skipped."""

from collections.abc import Callable
from typing import NamedTuple

from rotemina.drivers.gate import Permit
from rotemina.drivers.mc68hc11.codes import Refusal
from rotemina.drivers.mc68hc11.dialogue import Offered
from rotemina.drivers.mc68hc11.framing import RESYNC, Frame, encoded
from rotemina.drivers.mc68hc11.message import Message
from rotemina.drivers.mc68hc11.reports import Done, Refused
from rotemina.drivers.mc68hc11.requests import SetPoint

UNDER_WAY = 4  # set-points without an answer
_MANY = 255  # more are left than one can say
_AGAIN = (Refusal.OUT_OF_ORDER, Refusal.QUEUE_FULL)


class Due(NamedTuple):
    """A set-point: the board's unwrapped time, and its axes' positions, steps."""

    time_us: int
    steps: tuple[int, ...]


class _Underway(NamedTuple):
    place: int
    due_s: float


class SetpointWindow:
    """The set-points of one stream to one board.

    Parameters
    ----------
    address : int
    count : int
        Of set-points in all.
    due : callable
        Return a set-point by its number.
    answer_s : float
        After what time an answer is missing.
    permit : Permit
        Of the playback: every set-point passes the gate with it.
    """

    def __init__(
        self,
        address: int,
        count: int,
        due: Callable[[int], Due],
        answer_s: float,
        permit: Permit,
    ) -> None:
        self._permit = permit
        self._address = address
        self._count = count
        self._due = due
        self._answer_s = answer_s
        self._taken = 0  # that the board has
        self._next = 0
        self._released = 0  # that may be sent so far
        self._underway: dict[int, _Underway] = {}  # by the frame's number
        self._said = 0  # the farthest ever
        self._back = False
        self._not_before_s = float("-inf")
        self.repeated = 0
        self.refusal: int | None = None

    @property
    def taken(self) -> int:
        """How many set-points the board has acknowledged."""
        return self._taken

    def release(self, count: int) -> None:
        """Let the first ``count`` set-points go out; more may follow."""
        self._released = min(max(count, self._released), self._count)

    def offer(self, now_s: float) -> bool:
        """Return whether a set-point is to be said now."""
        if self.refusal is not None or now_s < self._not_before_s:
            return False
        oldest = next(iter(self._underway.values()), None)
        if oldest is not None and now_s >= oldest.due_s:
            self._go_back()
        return self._next < self._released and self._next - self._taken < UNDER_WAY

    def take(self, now_s: float, number: int, out_s: float) -> Offered:
        """Return the next set-point; ``out_s`` from now its bytes are out."""
        index, due = self._next, self._due(self._next)
        steps = (*due.steps, 0, 0, 0)
        message = SetPoint(
            index % 256, min(self._count - 1 - index, _MANY), due.time_us % (1 << 32), *steps[:3]
        )
        self._underway.pop(number, None)
        self._underway[number] = _Underway(index, now_s + out_s + self._answer_s)
        self._next += 1
        frame = encoded(Frame(self._address, number, SetPoint.TYPE, message.packed()))
        if index < self._said:
            self.repeated += 1
        self._said = max(self._said, self._next)
        if self._back:
            self._back = False
            return Offered(RESYNC + frame, self._permit, begins=False)
        return Offered(frame, self._permit, begins=False)

    def receive(self, message: Message, now_s: float) -> bool:
        """Take a message as the answer to a set-point if it is one; return whether it was."""
        if not isinstance(message, Done | Refused) or message.number not in self._underway:
            return False
        index = self._underway.pop(message.number).place
        if isinstance(message, Done):
            # In order only: whatever came before this one is there too.
            self._taken = max(self._taken, index + 1)
            self._next = max(self._next, self._taken)
            self._underway = {n: one for n, one in self._underway.items() if one.place > index}
        elif message.reason in _AGAIN:
            if message.reason == Refusal.QUEUE_FULL:
                self._not_before_s = now_s + self._answer_s
            self._go_back()
        else:
            self.refusal = message.reason
        return True

    def _go_back(self) -> None:
        """Say all again from the first one that is missing; answers under way count no more."""
        self._underway.clear()
        self._next = self._taken
        self._back = True
