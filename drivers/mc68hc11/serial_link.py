"""One serial line and all that is said on it: whose turn it is, and how the line does.

At most one frame at a time is with the operating system, so that a stop waits for no other. On a
shared bus the host stays silent until the boards that it asked have answered.

A USB adapter adds its frame of 1 ms; its latency timer, usually 16 ms, delays only answers.
"""

import logging
from collections.abc import Callable, Sequence
from contextlib import nullcontext

from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import DriverError, LimitError, ProtocolError
from rotemina.drivers.gate import GateError
from rotemina.drivers.line_quality import LinkQuality
from rotemina.drivers.mc68hc11.dialogue import Dialogue, Offered, Urgency
from rotemina.drivers.mc68hc11.framing import (
    BROADCAST,
    MAX_FRAME,
    STOP_BYTES,
    Decoder,
    Frame,
    encoded,
)
from rotemina.drivers.mc68hc11.host_messages import Poll
from rotemina.drivers.mc68hc11.line_budget import Line
from rotemina.drivers.mc68hc11.messages import message_of
from rotemina.drivers.mc68hc11.payload import Message
from rotemina.drivers.mc68hc11.segment_window import SetpointWindow
from rotemina.drivers.mc68hc11.wire_guard import LineGuard
from rotemina.drivers.serial_port import Port, UrgentBytes

_LOG = logging.getLogger(__name__)
_EARLY_S = 3e-4  # before the line is free: what a frame may wait for it
_IN_THE_WAY = 3 * MAX_FRAME  # bytes: telemetry, captured samples and the answer itself
_LOAD_S = 0.5  # over which the load is counted

MessageHandler = Callable[
    [int, Message, float], None
]  # the board's address, what it said, host time


class Link:
    """One line, with one board or two on it.

    Parameters
    ----------
    port : Port
    url : str
        How messages call the line.
    baud : int
    addresses : sequence of int
        Of the boards on it.
    latency_s : float
        What the operating system and its adapters may add to a round trip.
    clock : callable
        Host time, s.
    handle : callable
        Called with every message of a board.
    poll : callable
        Return the address to be polled at a host time on a shared bus, or None.
    """

    def __init__(
        self,
        port: Port,
        url: str,
        baud: int,
        addresses: Sequence[int],
        latency_s: float,
        clock: Clock,
        handle: MessageHandler,
        poll: Callable[[float], int | None],
    ) -> None:
        self.url = url
        self.half_duplex = True  # until the boards have said otherwise
        self._port = port
        self._line = Line(baud)
        self._clock = clock
        self._handle = handle
        self._poll = poll
        answer_s = self._line.seconds(_IN_THE_WAY) + latency_s
        self.answer_s = answer_s
        self.dialogues = {one: Dialogue(one, answer_s) for one in addresses}
        self.windows: dict[int, SetpointWindow] = {}
        self.said_s = dict.fromkeys(addresses, clock())
        self._decoder = Decoder()
        # What tells apart why no board answers: any bytes, own frames that came back, frames of
        # boards that nobody asked.
        self.received_bytes = self.echoes = 0
        self.strangers: set[int] = set()
        self._number = int(1e3 * clock()) & 0xFF
        self._free_s = float("-inf")
        self._awaited: set[int] = set()
        self._awaited_until_s = float("-inf")
        self._polled = False  # by what was said last
        self._sent = self._refused = self._discarded = self._repeated = 0
        #: The last check of what is written; it knows the boards' axes once they were added.
        self.guard = LineGuard()
        #: Why the gate or the guard held a frame back; the thread that serves the link takes it.
        self.held_back: DriverError | None = None
        self._bytes = [0, 0]  # out, in
        self._load, self._load_since_s = 0.0, clock()

    def count_discarded(self) -> None:
        """Count a report that cannot be true."""
        self._discarded += 1

    @property
    def rejected(self) -> int:
        """Stretches of bytes that were no frame or no message, and reports that cannot be true."""
        return self._decoder.rejected + self._refused + self._discarded

    @property
    def unknown_messages(self) -> int:
        """Valid frames of boards whose message is none of this version of the protocol."""
        return self._refused

    def await_answers(self, round_trip_s: float) -> None:
        """Let an answer take at least as long as one took that was measured."""
        least_s = round_trip_s + self._line.seconds(_IN_THE_WAY)
        self.answer_s = max(self.answer_s, least_s)
        for dialogue in self.dialogues.values():
            dialogue.answer_s = self.answer_s

    def seconds(self, count: int) -> float:
        """Return how long some bytes are on the line."""
        return self._line.seconds(count)

    def stop(self) -> None:
        """Say stop, now, whatever else is going on; any thread."""
        now_s = self._clock()
        data = self._stop_bytes(now_s)
        self._port.write(UrgentBytes(data))
        self._free_s = max(self._free_s, now_s) + self._line.seconds(len(data))

    def cancel_pending(self) -> None:
        """Wait for no answers any more: a stop has cut them off."""
        self._awaited.clear()

    def close_with(self, frames: Sequence[bytes]) -> None:
        """Stop, say the last words, and let go of the port."""
        try:
            self._port.write(UrgentBytes(STOP_BYTES + b"".join(frames)))
        finally:
            self._port.close()

    def close(self) -> None:
        """Let go of the port."""
        self._port.close()

    def receive(self) -> None:
        """Hand out what has arrived.

        Raises
        ------
        ConnectionLostError
            If the port is gone.
        """
        received = self._port.read()
        if not received:
            return
        self._bytes[1] += len(received)
        self.received_bytes += len(received)
        now_s = self._clock()
        for frame in self._decoder.feed(received):
            self._hear(frame, now_s)

    def send(self) -> None:
        """Say the most urgent thing, if the line is free.

        Raises
        ------
        ConnectionLostError
            If the port is gone.
        """
        now_s = self._clock()
        self._count_load(now_s)
        if not self._free(now_s):
            return
        said = self._next(now_s)
        if said is None:
            return
        address, (data, permit, begins) = said
        try:
            self.guard.check(data)
            with permit.passing(begins=begins) if permit is not None else nullcontext():
                self._port.write(data)
        except (GateError, LimitError) as error:
            if isinstance(error, LimitError):
                _LOG.error("%s: a frame was held back: %s", self.url, error)
            if begins:
                self.dialogues[address].give_up()
            else:
                self.end_stream(address)
            self.held_back = error
            return
        self._sent += 1
        self._bytes[0] += len(data)
        self._free_s = max(self._free_s, now_s) + self._line.seconds(len(data))
        heard_by = tuple(self.dialogues) if address == BROADCAST else (address,)
        for one in heard_by:
            self.said_s[one] = now_s
        if self.half_duplex:
            self._awaited = set(heard_by)
            self._awaited_until_s = self._free_s + self.answer_s

    def quality(self) -> LinkQuality:
        """Return how the line does; any thread."""
        trips = [one.round_trip_s for one in self.dialogues.values() if one.round_trip_s]
        now_s = self._clock()
        waits_s = max(self._free_s - now_s, 0.0)
        repeated = sum(one.repeated for one in self.dialogues.values())
        repeated += sum(one.repeated for one in tuple(self.windows.values()))
        return LinkQuality(
            sent=self._sent,
            received=self._decoder.frames,
            rejected=self.rejected,
            repeated=repeated + self._repeated,
            round_trip_s=max(trips) if trips else None,
            stop_s=waits_s + self._line.seconds(len(self._stop_bytes(now_s))),
            load=self._load,
        )

    def begin_stream(self, address: int, window: SetpointWindow) -> None:
        """Let the set-points of a window go out to a board."""
        self.end_stream(address)
        self.windows[address] = window

    def end_stream(self, address: int) -> None:
        """Say no more set-points to a board."""
        window = self.windows.pop(address, None)
        self._repeated += window.repeated if window is not None else 0

    def _stop_bytes(self, now_s: float) -> bytes:
        """Return what says stop.

        A board that speaks on a shared bus hears nothing: zeros go on until its frame has ended.
        """
        if self.half_duplex and self._awaited and now_s >= self._free_s:
            return bytes(MAX_FRAME + len(STOP_BYTES))
        return STOP_BYTES

    def _free(self, now_s: float) -> bool:
        if self.half_duplex:
            if now_s >= self._awaited_until_s:
                self._awaited.clear()
            if self._awaited:
                return False
        early_s = 0.0 if self.half_duplex else _EARLY_S
        return now_s >= self._free_s - early_s and not self._port.waiting()

    def _next(self, now_s: float) -> tuple[int, Offered] | None:
        """Return the address and the frame of what is said next."""
        offers = []
        for address, dialogue in self.dialogues.items():
            urgency = dialogue.offer(now_s)
            if urgency is not None:
                offers.append((urgency, self.said_s[address], address, False))
            window = self.windows.get(address)
            if window is not None and not dialogue.waiting and window.offer(now_s):
                offers.append((Urgency.STREAM, self.said_s[address], address, True))
        urgency, _, address, streams = min(offers, default=(Urgency.BACKGROUND, 0.0, 0, False))
        # Polls take turns with set-points, and with requests without haste: there may always be
        # something to poll for, and many set-points at first.
        yields = bool(offers) and self._polled
        self._polled = False
        if urgency >= Urgency.STREAM and self.half_duplex and not yields:
            # A board may repeat its last answer only: nothing comes between a request and it.
            polled = None if any(d.waiting for d in self.dialogues.values()) else self._poll(now_s)
            if polled is not None:
                self._polled = True
                number = self._counted()
                return polled, Offered(
                    encoded(Frame(polled, number, Poll.TYPE, Poll().packed())), None
                )
        if not offers:
            return None
        teller = self.windows[address] if streams else self.dialogues[address]
        out_s = max(self._free_s - now_s, 0.0) + self._line.seconds(MAX_FRAME)
        return address, teller.take(now_s, self._counted(), out_s)

    def _counted(self) -> int:
        self._number = (self._number + 1) & 0xFF
        return self._number

    def _hear(self, frame: Frame, now_s: float) -> None:
        dialogue = self.dialogues.get(frame.address)
        if not frame.from_board:
            self.echoes += 1
            return
        if dialogue is None:
            self.strangers.add(frame.address)
            return
        try:
            message = message_of(frame.type, frame.payload)
        except ProtocolError:
            self._refused += 1
            return
        self._awaited.discard(frame.address)
        window = self.windows.get(frame.address)
        if window is not None:
            window.receive(message, now_s)
        dialogue.receive(message, now_s)
        self._handle(frame.address, message, now_s)

    def _count_load(self, now_s: float) -> None:
        elapsed_s = now_s - self._load_since_s
        if elapsed_s < _LOAD_S:
            return
        used = sum(self._bytes) if self.half_duplex else max(self._bytes)
        self._load = min(self._line.seconds(used) / elapsed_s, 1.0)
        self._bytes = [0, 0]
        self._load_since_s = now_s
