"""The window of segments on their way to one board: several at once, in order, none skipped."""

from collections.abc import Callable

from rotemina.drivers.gate import Permit
from rotemina.drivers.mc68hc11.board_messages import Refused, Telemetry
from rotemina.drivers.mc68hc11.dialogue import Offered
from rotemina.drivers.mc68hc11.framing import RESYNC, Frame, encoded
from rotemina.drivers.mc68hc11.host_messages import SetPoint
from rotemina.drivers.mc68hc11.payload import Message
from rotemina.drivers.mc68hc11.protocol_codes import Refusal

MOST_WAY = ((1 << 23) - 1) // 2  # steps between two set-points: a second difference is two of them
ROUNDING = 1.0  # steps between two set-points beyond the greatest speed: each is a whole step
UNDER_WAY = 8  # segments that telemetry has not told of: some adapters hand it on every 16 ms only
_INDICES = 256
_AGAIN = (Refusal.OUT_OF_ORDER, Refusal.QUEUE_FULL)


class SetpointWindow:
    """The segments of one stream to one board that has begun it.

    Parameters
    ----------
    address : int
    count : int
        Of segments in all.
    segment : callable
        Return a segment by its number.
    told_s : callable
        Return after what time telemetry should have told that a segment is there.
    permit : Permit
        Of the playback: every segment passes the gate with it.
    """

    def __init__(
        self,
        address: int,
        count: int,
        segment: Callable[[int], SetPoint],
        told_s: Callable[[], float],
        permit: Permit,
    ) -> None:
        self._permit = permit
        self._address = address
        self._count = count
        self._segment = segment
        self._told_s = told_s
        self._taken = 0  # that the board has
        self._next = 0
        self._released = 0  # that may be sent so far
        self._underway: dict[int, int] = {}  # places by the frame's number
        self._due_s = float("inf")  # when telemetry should have told of the first one under way
        self._said = 0  # the farthest ever
        self._back = False
        self._not_before_s = float("-inf")
        self.repeated = 0
        self.refusal: int | None = None

    @property
    def taken(self) -> int:
        """How many segments the board has told that it has."""
        return self._taken

    def release(self, count: int) -> None:
        """Let the first ``count`` segments go out; more may follow."""
        self._released = min(max(count, self._released), self._count)

    def offer(self, now_s: float) -> bool:
        """Return whether a segment is to be said now."""
        if self.refusal is not None or now_s < self._not_before_s:
            return False
        if self._underway and now_s >= self._due_s:
            self._go_back()
        return self._next < self._released and self._next - self._taken < UNDER_WAY

    def take(self, now_s: float, number: int, out_s: float) -> Offered:
        """Return the next segment; ``out_s`` from now its bytes are out."""
        place = self._next
        message = self._segment(place)
        if not self._underway:
            self._due_s = now_s + out_s + self._told_s()
        self._underway[number] = place
        self._next += 1
        frame = encoded(Frame(self._address, number, SetPoint.TYPE, message.packed()))
        if place < self._said:
            self.repeated += 1
        self._said = max(self._said, self._next)
        if self._back:
            self._back = False
            return Offered(RESYNC + frame, self._permit, begins=False)
        return Offered(frame, self._permit, begins=False)

    def receive(self, message: Message, now_s: float) -> None:
        """Take what the board says; telemetry tells what it has, a refusal what it has not."""
        if isinstance(message, Telemetry):
            more = (message.expected - self._taken) % _INDICES
            if 0 < more <= self._said - self._taken:
                self._taken += more
                self._next = max(self._next, self._taken)
                self._underway = {n: p for n, p in self._underway.items() if p >= self._taken}
                self._due_s = now_s + self._told_s()
        elif isinstance(message, Refused) and message.number in self._underway:
            if message.reason not in _AGAIN:
                self.refusal = message.reason
                return
            if message.reason == Refusal.QUEUE_FULL:
                self._not_before_s = now_s + self._told_s()
            self._go_back()

    def _go_back(self) -> None:
        """Say all again from the first one that is missing; what is under way counts no more."""
        self._underway.clear()
        self._next = self._taken
        self._back = True
