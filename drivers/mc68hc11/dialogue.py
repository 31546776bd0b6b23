"""Requests to one board: each is repeated until the board answers, and then the next one is sent.

A board does not execute a repeated frame again, but it remembers only the number of the last frame.
So nothing else is sent to the board while a request is unanswered. Set-points are an exception,
because they have their own index.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum
from typing import NamedTuple

from rotemina.drivers.contract import Permit, StateError
from rotemina.drivers.mc68hc11.protocol import (
    RESYNC_BYTES,
    FrameDone,
    FrameRefused,
    SerialFrame,
    WireMessage,
    encode_frame,
)

# Limit for each urgency. It is sufficient for a profile together with all parameters.
_MAX_QUEUED_REQUESTS = 96


class RequestUrgency(IntEnum):
    """Urgency of a request. Requests with the lowest number are sent first."""

    STOP = 0
    COMMAND = 1
    STREAM = 2
    BACKGROUND = 3


# Called with the answer and the host time, s, at which it arrived.
AnswerHandler = Callable[[WireMessage, float], None]


@dataclass(slots=True, kw_only=True, eq=False)
class BoardRequest:
    """Message to a board that expects an answer.

    Attributes
    ----------
    message : WireMessage
    urgency : RequestUrgency
    answer_type : type
        Type of the message that answers the request. A refusal is always an answer, too.
    is_answer : callable
        Return whether a message of this type is the answer.
    on_answer : callable
        Called with the answer and the host time, s.
    on_refusal : callable
        Called with the reason of a refusal, or with None if the request was not answered in time.
    expires_s : float
        Host time after which the request is no longer sent.
    permit : Permit or None
        Permit with which the frame passes the gate. None for a message that causes no motion.
    """

    message: WireMessage
    urgency: RequestUrgency = RequestUrgency.COMMAND
    answer_type: type[WireMessage] = FrameDone
    is_answer: Callable[[WireMessage], bool] = lambda _: True
    on_answer: AnswerHandler = lambda _message, _now_s: None
    on_refusal: Callable[[int | None], None] = lambda _: None
    expires_s: float = float("inf")
    permit: Permit | None = None


class OutgoingFrame(NamedTuple):
    """Bytes of a frame, and the permit with which they pass the gate.

    ``begins`` is false if the frame continues a motion that has already begun.
    """

    data: bytes
    permit: Permit | None
    starts_motion: bool = True


@dataclass(slots=True)
class _SentRequest:
    request: BoardRequest
    number: int
    frame: bytes
    sent_s: float
    # Host time at which the frame is repeated, s.
    repeat_at_s: float
    send_count: int = 1


class BoardDialogue:
    """Queue of requests to one board.

    Parameters
    ----------
    address : int
        Address of the board.
    answer_s : float
        Time, s, after which an unanswered request is repeated.

    Attributes
    ----------
    repeat_count : int
        Number of frames that were repeated.
    round_trip_s : float or None
        Smoothed time from a request to its answer, s.
    """

    def __init__(self, address: int, answer_s: float) -> None:
        self.address = address
        self.answer_s = answer_s
        self.repeat_count = 0
        self.round_trip_s: float | None = None
        self._queues: dict[RequestUrgency, deque[BoardRequest]] = {
            urgency: deque() for urgency in RequestUrgency
        }
        self._sent: _SentRequest | None = None

    @property
    def has_requests(self) -> bool:
        """Whether a request is queued or waits for its answer."""
        return self._sent is not None or any(self._queues.values())

    @property
    def is_awaiting_answer(self) -> bool:
        """Whether a sent request has not been answered yet."""
        return self._sent is not None

    def has_request(self, urgency: RequestUrgency) -> bool:
        """Return whether a request of this urgency is queued or waits for its answer."""
        is_sent = self._sent is not None and self._sent.request.urgency is urgency
        return is_sent or bool(self._queues[urgency])

    def ask(self, request: BoardRequest) -> None:
        """Queue a request.

        Raises
        ------
        StateError
            If too many requests of its urgency are queued already.
        """
        queue = self._queues[request.urgency]
        if len(queue) >= _MAX_QUEUED_REQUESTS:
            raise StateError(
                "board {address}: {count} requests are already waiting; try again later",
                address=self.address,
                count=len(queue),
            )
        queue.append(request)

    def cancel_requests(self) -> None:
        """Cancel all requests except stops, including the one that has been sent."""
        for urgency, queue in self._queues.items():
            if urgency is not RequestUrgency.STOP:
                queue.clear()
        if self._sent is not None and self._sent.request.urgency is not RequestUrgency.STOP:
            self._sent = None

    def cancel_current(self) -> None:
        """Cancel the request of the latest :meth:`take_frame`, because its frame was not sent."""
        sent_request, self._sent = self._sent, None
        if sent_request is not None:
            sent_request.request.on_refusal(None)

    def find_next_urgency(self, now_s: float) -> RequestUrgency | None:
        """Return the urgency of the next frame to send, or None if there is none to send now."""
        sent_request = self._sent
        if sent_request is not None:
            if now_s < sent_request.repeat_at_s:
                return None
            if now_s < sent_request.request.expires_s:
                return sent_request.request.urgency
            self._sent = None
            sent_request.request.on_refusal(None)
        for urgency, queue in self._queues.items():
            while queue:
                if now_s < queue[0].expires_s:
                    return urgency
                queue.popleft().on_refusal(None)
        return None

    def take_frame(self, now_s: float, number: int, out_s: float) -> OutgoingFrame:
        """Return the frame of the request that :meth:`find_next_urgency` has found.

        Parameters
        ----------
        now_s : float
            Host time, s.
        number : int
            Number of the frame.
        out_s : float
            Time from now until a frame of full length has left the line, s.
        """
        sent_request = self._sent
        if sent_request is not None:
            self.repeat_count += 1
            sent_request.send_count += 1
            sent_request.repeat_at_s = now_s + out_s + self.answer_s
            return OutgoingFrame(RESYNC_BYTES + sent_request.frame, sent_request.request.permit)
        queue = next(queue for queue in self._queues.values() if queue)
        request = queue.popleft()
        message = request.message
        frame = encode_frame(SerialFrame(self.address, number, message.TYPE, message.pack()))
        self._sent = _SentRequest(request, number, frame, now_s, now_s + out_s + self.answer_s)
        return OutgoingFrame(frame, request.permit)

    def receive(self, message: WireMessage, now_s: float) -> bool:
        """Handle a message if it answers the current request. Return whether it does."""
        sent_request = self._sent
        if sent_request is None:
            return False
        request = sent_request.request
        if isinstance(message, FrameRefused):
            if message.number != sent_request.number:
                return False
            self._sent = None
            request.on_refusal(message.reason)
            return True
        if not isinstance(message, request.answer_type) or not request.is_answer(message):
            return False
        if isinstance(message, FrameDone) and message.number != sent_request.number:
            # This is a late answer to a request that was cancelled.
            return False
        self._sent = None
        # If the request was repeated, it is unknown which of its frames is answered.
        if sent_request.send_count == 1:
            elapsed_s = now_s - sent_request.sent_s
            average_s = self.round_trip_s
            self.round_trip_s = (
                elapsed_s if average_s is None else average_s + 0.125 * (elapsed_s - average_s)
            )
        request.on_answer(message, now_s)
        return True
