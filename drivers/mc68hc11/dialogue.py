"""What is said to one board, one request after the other, each until it is answered.

A board executes no frame twice in a row, but knows the number of the last one alone. So while a
request is unanswered nothing else is said to its board; set-points, which are counted, excepted.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum
from typing import NamedTuple

from rotemina.drivers.errors import StateError
from rotemina.drivers.gate import Permit
from rotemina.drivers.mc68hc11.board_messages import Done, Refused
from rotemina.drivers.mc68hc11.framing import RESYNC, Frame, encoded
from rotemina.drivers.mc68hc11.payload import Message
from rotemina.sim.messages import message

_MOST_QUEUED = 96  # requests of one urgency: a profile and all parameters, and some


class Urgency(IntEnum):
    """Which request goes first."""

    STOP = 0
    COMMAND = 1
    STREAM = 2
    BACKGROUND = 3


Answered = Callable[[Message, float], None]  # the answer, and the host's time


@dataclass(slots=True, kw_only=True, eq=False)
class Request:
    """Something that is asked of a board.

    Attributes
    ----------
    message : Message
    urgency : Urgency
    answer : type
        Of the message that answers it; a refusal ends it too.
    matches : callable
        Whether a message of this type is the answer.
    answered, refused : callable
        Called with the answer, or with the reason of a refusal (None: nobody answered in time).
    expires_s : float
        Host time after which it is said no more.
    permit : Permit or None
        What its frame passes the gate with; None for what moves nothing.
    """

    message: Message
    urgency: Urgency = Urgency.COMMAND
    answer: type[Message] = Done
    matches: Callable[[Message], bool] = lambda _: True
    answered: Answered = lambda _message, _at_s: None
    refused: Callable[[int | None], None] = lambda _: None
    expires_s: float = float("inf")
    permit: Permit | None = None


class Offered(NamedTuple):
    """The bytes of a frame, and what they pass the gate with."""

    data: bytes
    permit: Permit | None
    begins: bool = True  # False where a motion that has begun goes on


@dataclass(slots=True)
class _SentRequest:
    """A request that waits for its answer."""

    request: Request
    number: int
    frame: bytes
    said_s: float  # when its last byte was out, as far as one can tell
    due_s: float
    times: int = 1


class Dialogue:
    """The requests to one board.

    Parameters
    ----------
    address : int
        The board's.
    answer_s : float
        After what time an answer is missing.
    """

    def __init__(self, address: int, answer_s: float) -> None:
        self.address = address
        self.answer_s = answer_s
        self.repeated = 0
        self.round_trip_s: float | None = None
        self._queues: dict[Urgency, deque[Request]] = {each: deque() for each in Urgency}
        self._sent: _SentRequest | None = None

    @property
    def busy(self) -> bool:
        """Whether a request waits for its turn or its answer."""
        return self._sent is not None or any(self._queues.values())

    @property
    def waiting(self) -> bool:
        """Whether a request waits for its answer."""
        return self._sent is not None

    def has(self, urgency: Urgency) -> bool:
        """Whether a request of this urgency waits for its turn or its answer."""
        said = self._sent is not None and self._sent.request.urgency is urgency
        return said or bool(self._queues[urgency])

    def ask(self, request: Request) -> None:
        """Queue a request.

        Raises
        ------
        StateError
            If too many wait already.
        """
        queue = self._queues[request.urgency]
        if len(queue) >= _MOST_QUEUED:
            raise StateError(
                message("engine", "board {address}: {count} requests wait for it; wait").fill(
                    address=self.address, count=len(queue)
                )
            )
        queue.append(request)

    def drop(self) -> None:
        """Forget every request but stops: what is under way too is never said again."""
        for urgency, queue in self._queues.items():
            if urgency is not Urgency.STOP:
                queue.clear()
        if self._sent is not None and self._sent.request.urgency is not Urgency.STOP:
            self._sent = None

    def give_up(self) -> None:
        """Forget the request that was taken last: it is never said."""
        said, self._sent = self._sent, None
        if said is not None:
            said.request.refused(None)

    def offer(self, now_s: float) -> Urgency | None:
        """Return the urgency of what there is to say now, or None."""
        said = self._sent
        if said is not None:
            if now_s < said.due_s:
                return None
            if now_s < said.request.expires_s:
                return said.request.urgency
            self._sent = None
            said.request.refused(None)
        for urgency, queue in self._queues.items():
            while queue:
                if now_s < queue[0].expires_s:
                    return urgency
                queue.popleft().refused(None)
        return None

    def take(self, now_s: float, number: int, out_s: float) -> Offered:
        """Return what `offer` had; ``out_s`` from the call each of 32 bytes is out."""
        said = self._sent
        if said is not None:
            self.repeated += 1
            said.times += 1
            said.due_s = now_s + out_s + self.answer_s
            return Offered(RESYNC + said.frame, said.request.permit)
        queue = next(queue for queue in self._queues.values() if queue)
        request = queue.popleft()
        message = request.message
        frame = encoded(Frame(self.address, number, message.TYPE, message.packed()))
        self._sent = _SentRequest(request, number, frame, now_s, now_s + out_s + self.answer_s)
        return Offered(frame, request.permit)

    def receive(self, message: Message, now_s: float) -> bool:
        """Take a message as the answer if it is one; return whether it was."""
        said = self._sent
        if said is None:
            return False
        request = said.request
        if isinstance(message, Refused):
            if message.number != said.number:
                return False
            self._sent = None
            request.refused(message.reason)
            return True
        if not isinstance(message, request.answer) or not request.matches(message):
            return False
        if isinstance(message, Done) and message.number != said.number:
            return False  # late, of a request that was given up
        self._sent = None
        if said.times == 1:
            took_s = now_s - said.said_s
            before = self.round_trip_s
            self.round_trip_s = took_s if before is None else before + 0.125 * (took_s - before)
        request.answered(message, now_s)
        return True
