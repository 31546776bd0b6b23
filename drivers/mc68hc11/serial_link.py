"""One serial line: decides what is sent next, and measures the quality of the line.

At most one frame at a time is in the buffers of the operating system, so a stop waits for at most
one frame. On a shared bus the host sends nothing until the boards have answered.

A USB adapter delays a stop by its frame of 1 ms. Its latency timer, usually 16 ms, delays only
answers.
"""

import logging
from collections.abc import Callable, Sequence
from contextlib import nullcontext
from typing import NamedTuple

from rotemina.drivers.contract import (
    Clock,
    DriverError,
    GateError,
    LimitError,
    LinkQuality,
    ProtocolError,
)
from rotemina.drivers.mc68hc11.dialogue import BoardDialogue, OutgoingFrame, RequestUrgency
from rotemina.drivers.mc68hc11.line_budget import LineCapacity
from rotemina.drivers.mc68hc11.protocol import (
    BROADCAST_ADDRESS,
    MAX_FRAME_BYTES,
    STOP_BYTES,
    FrameDecoder,
    PollBoard,
    SerialFrame,
    WireMessage,
    encode_frame,
    unpack_message,
)
from rotemina.drivers.mc68hc11.segment_window import SegmentWindow
from rotemina.drivers.mc68hc11.wire_guard import LineGuard
from rotemina.drivers.serial_lines import BytePort, UrgentBytes

_LOG = logging.getLogger(__name__)
# A frame may be written this long before the line is free.
_SEND_AHEAD_S = 3e-4
# A frame of telemetry and one of captured samples may precede the answer. The answer is included.
_MAX_BYTES_BEFORE_ANSWER = 3 * MAX_FRAME_BYTES
# The load is averaged over this time.
_LOAD_WINDOW_S = 0.5

# Called with the address of the board, its message and the host time, s.
MessageHandler = Callable[[int, WireMessage, float], None]


class _FrameCandidate(NamedTuple):
    """Frame that may be sent next. The smallest candidate is the most urgent one."""

    urgency: RequestUrgency
    last_sent_s: float
    address: int
    is_segment: bool


class SerialLink:
    """Serial line with one or two boards.

    Parameters
    ----------
    port : Port
    url : str
        Name of the line in messages.
    baud : int
    addresses : sequence of int
        Addresses of the boards on the line.
    latency_s : float
        Time that the operating system and adapters may add to a round trip, s.
    clock : callable
        Return the host time, s.
    handle : callable
        Called with every message from a board.
    poll : callable
        Return the address to poll at a host time, or None. Used only on a shared bus.
    """

    def __init__(
        self,
        port: BytePort,
        url: str,
        baud: int,
        addresses: Sequence[int],
        latency_s: float,
        clock: Clock,
        handle: MessageHandler,
        poll: Callable[[float], int | None],
    ) -> None:
        self.url = url
        # The line may be a shared bus until the boards have reported their abilities.
        self.half_duplex = True
        self._port = port
        self._line = LineCapacity(baud)
        self._clock = clock
        self._handle = handle
        self._poll = poll
        answer_s = self._line.compute_duration_s(_MAX_BYTES_BEFORE_ANSWER) + latency_s
        self.answer_s = answer_s
        self.dialogues = {address: BoardDialogue(address, answer_s) for address in addresses}
        self.windows: dict[int, SegmentWindow] = {}
        self.last_sent_s = dict.fromkeys(addresses, clock())
        self._decoder = FrameDecoder()
        # Diagnosis if a board does not answer: whether any bytes arrive, whether the host receives
        # its own frames, and whether other boards answer.
        self.received_bytes = self.echo_count = 0
        self.unexpected_addresses: set[int] = set()
        self._frame_number = int(1e3 * clock()) & 0xFF
        self._line_free_s = float("-inf")
        self._awaited_addresses: set[int] = set()
        self._awaited_until_s = float("-inf")
        # Whether the latest frame is a poll.
        self._last_was_poll = False
        self._sent_count = self._unknown_message_count = self._discarded_count = (
            self._repeat_count
        ) = 0
        #: Last check of all written bytes. It covers a board as soon as the board's guard is added.
        self.guard = LineGuard()
        #: Error with which the gate or the guard held back a frame. The thread that serves the link
        #: takes it.
        self.hold_back_error: DriverError | None = None
        # Numbers of bytes sent and received since the load was last computed.
        self._byte_counts = [0, 0]
        self._load, self._load_since_s = 0.0, clock()

    def count_discarded(self) -> None:
        """Count a report with an impossible position."""
        self._discarded_count += 1

    @property
    def rejected_count(self) -> int:
        """Number of invalid frames, unknown messages and reports with impossible positions."""
        return self._decoder.rejected_count + self._unknown_message_count + self._discarded_count

    @property
    def unknown_message_count(self) -> int:
        """Number of valid frames whose message this version of the protocol does not define."""
        return self._unknown_message_count

    def extend_answer_time(self, round_trip_s: float) -> None:
        """Extend the time for an answer to a measured round trip plus the longest answer."""
        min_answer_s = round_trip_s + self._line.compute_duration_s(_MAX_BYTES_BEFORE_ANSWER)
        self.answer_s = max(self.answer_s, min_answer_s)
        for dialogue in self.dialogues.values():
            dialogue.answer_s = self.answer_s

    def compute_duration_s(self, count: int) -> float:
        """Return the time that a number of bytes takes on the line, s."""
        return self._line.compute_duration_s(count)

    def stop(self) -> None:
        """Send stop immediately. Any thread may call it at any time."""
        now_s = self._clock()
        data = self._make_stop_bytes(now_s)
        self._port.write(UrgentBytes(data))
        self._line_free_s = max(self._line_free_s, now_s) + self._line.compute_duration_s(len(data))

    def cancel_pending(self) -> None:
        """Stop waiting for answers, because a stop has cancelled the requests."""
        self._awaited_addresses.clear()

    def close_with_frames(self, frames: Sequence[bytes]) -> None:
        """Send stop and the last frames, and close the port."""
        try:
            self._port.write(UrgentBytes(STOP_BYTES + b"".join(frames)))
        finally:
            self._port.close()

    def close(self) -> None:
        """Close the port."""
        self._port.close()

    def receive(self) -> None:
        """Handle the frames that have arrived.

        Raises
        ------
        ConnectionLostError
            If the port does not exist any more.
        """
        received = self._port.read()
        if not received:
            return
        self._byte_counts[1] += len(received)
        self.received_bytes += len(received)
        now_s = self._clock()
        for frame in self._decoder.feed(received):
            self._handle_frame(frame, now_s)

    def send(self) -> None:
        """Send the most urgent frame, if the line is free.

        Raises
        ------
        ConnectionLostError
            If the port does not exist any more.
        """
        now_s = self._clock()
        self._update_load(now_s)
        if not self._is_line_free(now_s):
            return
        frame = self._choose_next_frame(now_s)
        if frame is None:
            return
        address, (data, permit, begins) = frame
        try:
            self.guard.check(data)
            with permit.passing(begins=begins) if permit is not None else nullcontext():
                self._port.write(data)
        except (GateError, LimitError) as error:
            if isinstance(error, LimitError):
                _LOG.error("%s: a frame was held back: %s", self.url, error)
            if begins:
                self.dialogues[address].cancel_current()
            else:
                self.end_stream(address)
            self.hold_back_error = error
            return
        self._sent_count += 1
        self._byte_counts[0] += len(data)
        self._line_free_s = max(self._line_free_s, now_s) + self._line.compute_duration_s(len(data))
        receivers = tuple(self.dialogues) if address == BROADCAST_ADDRESS else (address,)
        for receiver in receivers:
            self.last_sent_s[receiver] = now_s
        if self.half_duplex:
            self._awaited_addresses = set(receivers)
            self._awaited_until_s = self._line_free_s + self.answer_s

    def read_quality(self) -> LinkQuality:
        """Return the quality of the line. Any thread may call it."""
        round_trips_s = [
            dialogue.round_trip_s for dialogue in self.dialogues.values() if dialogue.round_trip_s
        ]
        now_s = self._clock()
        backlog_s = max(self._line_free_s - now_s, 0.0)
        repeated = sum(dialogue.repeat_count for dialogue in self.dialogues.values())
        repeated += sum(window.repeat_count for window in tuple(self.windows.values()))
        return LinkQuality(
            sent=self._sent_count,
            received=self._decoder.frame_count,
            rejected=self.rejected_count,
            repeated=repeated + self._repeat_count,
            round_trip_s=max(round_trips_s) if round_trips_s else None,
            stop_s=backlog_s + self._line.compute_duration_s(len(self._make_stop_bytes(now_s))),
            load=self._load,
        )

    def begin_stream(self, address: int, window: SegmentWindow) -> None:
        """Start to send the set-points of a window to a board."""
        self.end_stream(address)
        self.windows[address] = window

    def end_stream(self, address: int) -> None:
        """Stop sending set-points to a board."""
        window = self.windows.pop(address, None)
        self._repeat_count += window.repeat_count if window is not None else 0

    def _make_stop_bytes(self, now_s: float) -> bytes:
        """Return the bytes that mean stop.

        On a shared bus a board does not receive while it sends. So the zeros continue until the
        board's frame must have ended.
        """
        if self.half_duplex and self._awaited_addresses and now_s >= self._line_free_s:
            return bytes(MAX_FRAME_BYTES + len(STOP_BYTES))
        return STOP_BYTES

    def _is_line_free(self, now_s: float) -> bool:
        if self.half_duplex:
            if now_s >= self._awaited_until_s:
                self._awaited_addresses.clear()
            if self._awaited_addresses:
                return False
        send_ahead_s = 0.0 if self.half_duplex else _SEND_AHEAD_S
        return now_s >= self._line_free_s - send_ahead_s and not self._port.waiting()

    def _choose_next_frame(self, now_s: float) -> tuple[int, OutgoingFrame] | None:
        candidates: list[_FrameCandidate] = []
        for address, dialogue in self.dialogues.items():
            urgency = dialogue.find_next_urgency(now_s)
            if urgency is not None:
                candidates.append(
                    _FrameCandidate(urgency, self.last_sent_s[address], address, False)
                )
            window = self.windows.get(address)
            if (
                window is not None
                and not dialogue.is_awaiting_answer
                and window.has_segment_to_send(now_s)
            ):
                candidates.append(
                    _FrameCandidate(RequestUrgency.STREAM, self.last_sent_s[address], address, True)
                )
        urgency, _, address, is_segment = min(
            candidates, default=_FrameCandidate(RequestUrgency.BACKGROUND, 0.0, 0, False)
        )
        # Polls alternate with set-points and background requests. Otherwise polls could block them
        # all the time, or the many set-points at the start of a stream could block the polls.
        must_skip_poll = bool(candidates) and self._last_was_poll
        self._last_was_poll = False
        if urgency >= RequestUrgency.STREAM and self.half_duplex and not must_skip_poll:
            # A board can repeat only its last answer. So while a request is unanswered, no poll is
            # sent.
            poll_address = (
                None
                if any(dialogue.is_awaiting_answer for dialogue in self.dialogues.values())
                else self._poll(now_s)
            )
            if poll_address is not None:
                self._last_was_poll = True
                number = self._take_frame_number()
                return poll_address, OutgoingFrame(
                    encode_frame(
                        SerialFrame(poll_address, number, PollBoard.TYPE, PollBoard().pack())
                    ),
                    None,
                )
        if not candidates:
            return None
        source = self.windows[address] if is_segment else self.dialogues[address]
        out_s = max(self._line_free_s - now_s, 0.0) + self._line.compute_duration_s(MAX_FRAME_BYTES)
        return address, source.take_frame(now_s, self._take_frame_number(), out_s)

    def _take_frame_number(self) -> int:
        self._frame_number = (self._frame_number + 1) & 0xFF
        return self._frame_number

    def _handle_frame(self, frame: SerialFrame, now_s: float) -> None:
        dialogue = self.dialogues.get(frame.address)
        if not frame.from_board:
            self.echo_count += 1
            return
        if dialogue is None:
            self.unexpected_addresses.add(frame.address)
            return
        try:
            message = unpack_message(frame.type, frame.payload)
        except ProtocolError:
            self._unknown_message_count += 1
            return
        self._awaited_addresses.discard(frame.address)
        window = self.windows.get(frame.address)
        if window is not None:
            window.receive(message, now_s)
        dialogue.receive(message, now_s)
        self._handle(frame.address, message, now_s)

    def _update_load(self, now_s: float) -> None:
        elapsed_s = now_s - self._load_since_s
        if elapsed_s < _LOAD_WINDOW_S:
            return
        byte_count = sum(self._byte_counts) if self.half_duplex else max(self._byte_counts)
        self._load = min(self._line.compute_duration_s(byte_count) / elapsed_s, 1.0)
        self._byte_counts = [0, 0]
        self._load_since_s = now_s
