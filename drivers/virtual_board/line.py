"""Serial line with the boards at its end, which simulates the timing of bytes.

On a paced line a byte arrives at the end of its stop bit, ten bits after the previous byte. On a
shared bus the boards answer after a slot in which the host may start another frame.
"""

from collections import deque
from collections.abc import Sequence
from math import inf
from typing import NamedTuple

from rotemina.drivers.mc68hc11 import LineCapacity
from rotemina.drivers.mc68hc11.protocol import (
    FrameDecoder,
    SerialFrame,
    WireMessage,
    encode_frame,
)
from rotemina.drivers.virtual_board.firmware import BoardFirmware
from rotemina.drivers.virtual_board.frame_execution import answer_frame
from rotemina.drivers.virtual_board.line_faults import CableChannel

# Silence after each frame on a shared bus.
_SLOT_BYTES = 3
# If more bytes are waiting, new telemetry is dropped, because it would arrive too late.
_MAX_BACKLOG_BYTES = 3 * 32
# Rounding error of a division, as a fraction of a byte.
_BYTE_ROUNDING = 1e-6


class _ReceivedPiece(NamedTuple):
    """Received bytes up to a zero, or up to the last byte that the host has written."""

    end_s: float
    data: bytes
    # A board that was sending and therefore does not receive these bytes.
    deaf_board: BoardFirmware | None


class _OutgoingBytes:
    def __init__(self, begin_s: float, data: bytearray, board: BoardFirmware | None) -> None:
        self.begin_s = begin_s
        self.data = data
        self.sent_count = 0
        self.board = board


class SerialLine:
    """Serial line with its boards.

    Parameters
    ----------
    boards : sequence of BoardFirmware
    capacity : LineCapacity
        Capacity of the line.
    paced : bool
        Whether bytes take the time that the baud rate implies.
    seed : int
        Seed of the disturbances on the cable.
    """

    def __init__(
        self, boards: Sequence[BoardFirmware], capacity: LineCapacity, *, paced: bool, seed: int
    ) -> None:
        self.boards = tuple(boards)
        self.is_bus = capacity.half_duplex
        self.byte_s = capacity.compute_duration_s(1) if paced else 0.0
        self.to_board = CableChannel(2 * seed)
        self.to_host = CableChannel(2 * seed + 1)
        self._decoders = [FrameDecoder(is_board=True) for _ in boards]
        self._received: deque[_ReceivedPiece] = deque()
        self._received_until_s = 0.0
        self._outgoing: deque[_OutgoingBytes] = deque()
        self._sent_until_s = 0.0
        self._delayed: deque[tuple[float, bytes]] = deque()
        self._answers: list[tuple[BoardFirmware, SerialFrame]] = []
        self._answer_s = inf

    @property
    def next_event_s(self) -> float:
        """Time at which the next bytes reach the boards, or a board begins to answer, s."""
        return min(self._received[0].end_s if self._received else inf, self._answer_s)

    @property
    def next_departure_s(self) -> float:
        """Time at which the next frame to the host has arrived completely, s."""
        outgoing = self._outgoing[0] if self._outgoing else None
        frame_end_s = (
            inf if outgoing is None else outgoing.begin_s + len(outgoing.data) * self.byte_s
        )
        return min(frame_end_s, self._delayed[0][0] if self._delayed else inf)

    def receive(self, data: bytes, at_s: float) -> None:
        """Receive bytes that the host has written at the time ``at_s``, which must not decrease."""
        data = self.to_board.transmit(data, at_s)
        at_s += self.to_board.delay_s
        for piece in _split_at_zeros(data):
            begin_s = max(at_s, self._received_until_s)
            end_s = begin_s + len(piece) * self.byte_s
            if begin_s < self._answer_s:
                # The host sends in the slot, so no board answers.
                self._answer_s, self._answers = inf, []
            deaf_board = self._apply_collision(begin_s, piece) if self.is_bus else None
            self._received.append(_ReceivedPiece(end_s, piece, deaf_board))
            self._received_until_s = end_s

    def process_next(self) -> None:
        """Process the next event."""
        if self._answer_s < (self._received[0].end_s if self._received else inf):
            self._send_answer()
            return
        received = self._received.popleft()
        answers = []
        for board, decoder in zip(self.boards, self._decoders, strict=True):
            if board is received.deaf_board:
                continue
            for frame in decoder.feed(received.data):
                reply = answer_frame(board, frame, received.end_s)
                if reply is not None:
                    answers.append((board, reply))
        if answers and not self.is_bus:
            for board, reply in answers:
                self._send(encode_frame(reply), received.end_s, board)
        elif answers and not (self._received and self.byte_s):
            self._answers += answers
            self._answer_s = received.end_s + _SLOT_BYTES * self.byte_s

    def send_messages(
        self, board: BoardFirmware, messages: Sequence[WireMessage], at_s: float
    ) -> None:
        """Send unsolicited messages of a board. Drop those that would arrive too late."""
        for message in messages:
            if self._sent_until_s - at_s <= _MAX_BACKLOG_BYTES * self.byte_s:
                self._send(encode_frame(board.make_frame(message)), at_s, board)

    def disturb(self, data: bytes, at_s: float, *, towards_host: bool) -> None:
        """Put spurious bytes on the line."""
        if towards_host:
            self._send(data, at_s, None)
        else:
            self.receive(data, at_s)

    def take_bytes(self, to_s: float) -> bytes:
        """Return the bytes that have reached the host by the time ``to_s``."""
        while self._outgoing:
            outgoing = self._outgoing[0]
            count = len(outgoing.data)
            if self.byte_s:
                count = min(count, int((to_s - outgoing.begin_s) / self.byte_s + _BYTE_ROUNDING))
            elif outgoing.begin_s > to_s:
                break
            if count > outgoing.sent_count:
                at_s = outgoing.begin_s + count * self.byte_s
                data = self.to_host.transmit(
                    bytes(outgoing.data[outgoing.sent_count : count]), at_s
                )
                self._delayed.append((at_s + self.to_host.delay_s, data))
                outgoing.sent_count = count
            if count < len(outgoing.data):
                break
            self._outgoing.popleft()
        received = b""
        while self._delayed and self._delayed[0][0] <= to_s + _BYTE_ROUNDING * self.byte_s:
            received += self._delayed.popleft()[1]
        return received

    def _send_answer(self) -> None:
        board, reply = self._answers.pop(0)
        self._send(encode_frame(reply), self._answer_s, board)
        if self._answers:
            self._answer_s = self._sent_until_s + _SLOT_BYTES * self.byte_s
        else:
            self._answer_s = inf

    def _send(self, data: bytes, at_s: float, board: BoardFirmware | None) -> None:
        begin_s = max(at_s, self._sent_until_s)
        self._outgoing.append(_OutgoingBytes(begin_s, bytearray(data), board))
        self._sent_until_s = begin_s + len(data) * self.byte_s

    def _apply_collision(self, begin_s: float, piece: bytes) -> BoardFirmware | None:
        """Corrupt the bytes of a board that is sending at the same time; return that board."""
        if not self.byte_s or begin_s >= self._sent_until_s:
            return None
        for outgoing in self._outgoing:
            first_index = int((begin_s - outgoing.begin_s) / self.byte_s)
            for index, byte in enumerate(piece, start=first_index):
                if outgoing.sent_count <= index < len(outgoing.data):
                    outgoing.data[index] &= byte
        return self._outgoing[-1].board if self._outgoing else None


def _split_at_zeros(data: bytes) -> list[bytes]:
    """Split bytes after each zero. A piece contains the zero that ends it."""
    pieces = [part + b"\0" for part in data.split(b"\0")]
    pieces[-1] = pieces[-1][:-1]
    return [piece for piece in pieces if piece]
