"""A serial line with the boards at its end, byte by byte in time.

Paced, a byte has come, and has left, when its stop bit is over: ten bits after the one before. On a
shared bus the boards answer after the slot in which the host may continue.
"""

from collections import deque
from collections.abc import Sequence
from math import inf
from typing import NamedTuple

from rotemina.drivers.mc68hc11.framing import Decoder, Frame, encoded
from rotemina.drivers.mc68hc11.line_budget import Line as Speed
from rotemina.drivers.mc68hc11.payload import Message
from rotemina.drivers.virtual_board.firmware import Firmware
from rotemina.drivers.virtual_board.frame_execution import answer
from rotemina.drivers.virtual_board.line_faults import Channel

_SLOT = 3  # bytes of silence after a frame on a shared bus
_BACKLOG = 3 * 32  # bytes: telemetry that waits longer is out of date, and left out
_ATOM = 1e-6  # of a byte, that division rounds by


class _Received(NamedTuple):
    """Bytes up to the first zero among them, or to the last of a piece; times in s."""

    end_s: float
    data: bytes
    deaf: Firmware | None  # the board that was speaking


class _Outgoing:
    """Bytes on their way to the host."""

    def __init__(self, begin_s: float, data: bytearray, board: Firmware | None) -> None:
        self.begin_s = begin_s
        self.data = data
        self.left = 0
        self.board = board


class SerialLine:
    """One line and its boards.

    Parameters
    ----------
    boards : sequence of Firmware
    speed : Line
        What the line can carry.
    paced : bool
        Whether bytes take their time.
    seed : int
        Of disturbances.
    """

    def __init__(self, boards: Sequence[Firmware], speed: Speed, *, paced: bool, seed: int) -> None:
        self.boards = tuple(boards)
        self.bus = speed.half_duplex
        self.byte_s = speed.seconds(1) if paced else 0.0
        self.to_board = Channel(2 * seed)
        self.to_host = Channel(2 * seed + 1)
        self._decoders = [Decoder(of_board=True) for _ in boards]
        self._received: deque[_Received] = deque()
        self._heard_until_s = 0.0
        self._outgoing: deque[_Outgoing] = deque()
        self._said_until_s = 0.0
        self._delayed: deque[tuple[float, bytes]] = deque()
        self._answers: list[tuple[Firmware, Frame]] = []
        self._speak_s = inf

    @property
    def next_s(self) -> float:
        """When something happens next: a byte has come, or a board begins to answer."""
        return min(self._received[0].end_s if self._received else inf, self._speak_s)

    @property
    def leaves_s(self) -> float:
        """When the next whole frame, or what is left of one, has reached the host."""
        said = self._outgoing[0] if self._outgoing else None
        ends_s = inf if said is None else said.begin_s + len(said.data) * self.byte_s
        return min(ends_s, self._delayed[0][0] if self._delayed else inf)

    def receive(self, data: bytes, at_s: float) -> None:
        """Let the host have written bytes at a time that is not before the latest one."""
        data = self.to_board.passed(data, at_s)
        at_s += self.to_board.delay_s
        for piece in _pieces(data):
            begin_s = max(at_s, self._heard_until_s)
            end_s = begin_s + len(piece) * self.byte_s
            if begin_s < self._speak_s:
                self._speak_s, self._answers = inf, []  # the host goes on: nobody answers
            deaf = self._collide(begin_s, piece) if self.bus else None
            self._received.append(_Received(end_s, piece, deaf))
            self._heard_until_s = end_s

    def step(self) -> None:
        """Let happen what happens next."""
        if self._speak_s < (self._received[0].end_s if self._received else inf):
            self._speak()
            return
        heard = self._received.popleft()
        answers = []
        for board, decoder in zip(self.boards, self._decoders, strict=True):
            if board is heard.deaf:
                continue
            for frame in decoder.feed(heard.data):
                said = answer(board, frame, heard.end_s)
                if said is not None:
                    answers.append((board, said))
        if answers and not self.bus:
            for board, said in answers:
                self._send(encoded(said), heard.end_s, board)
        elif answers and not (self._received and self.byte_s):
            self._answers += answers
            self._speak_s = heard.end_s + _SLOT * self.byte_s

    def say(self, board: Firmware, messages: Sequence[Message], at_s: float) -> None:
        """Let a board say something unasked; what the line has no room for is left out."""
        for message in messages:
            if self._said_until_s - at_s <= _BACKLOG * self.byte_s:
                self._send(encoded(board.framed(message)), at_s, board)

    def disturb(self, data: bytes, at_s: float, *, towards_host: bool) -> None:
        """Put spurious bytes on the line."""
        if towards_host:
            self._send(data, at_s, None)
        else:
            self.receive(data, at_s)

    def taken(self, to_s: float) -> bytes:
        """Return the bytes that have reached the host by then."""
        while self._outgoing:
            said = self._outgoing[0]
            count = len(said.data)
            if self.byte_s:
                count = min(count, int((to_s - said.begin_s) / self.byte_s + _ATOM))
            elif said.begin_s > to_s:
                break
            if count > said.left:
                at_s = said.begin_s + count * self.byte_s
                passed = self.to_host.passed(bytes(said.data[said.left : count]), at_s)
                self._delayed.append((at_s + self.to_host.delay_s, passed))
                said.left = count
            if count < len(said.data):
                break
            self._outgoing.popleft()
        out = b""
        while self._delayed and self._delayed[0][0] <= to_s + _ATOM * self.byte_s:
            out += self._delayed.popleft()[1]
        return out

    def _speak(self) -> None:
        board, said = self._answers.pop(0)
        self._send(encoded(said), self._speak_s, board)
        if self._answers:
            self._speak_s = self._said_until_s + _SLOT * self.byte_s
        else:
            self._speak_s = inf

    def _send(self, data: bytes, at_s: float, board: Firmware | None) -> None:
        begin_s = max(at_s, self._said_until_s)
        self._outgoing.append(_Outgoing(begin_s, bytearray(data), board))
        self._said_until_s = begin_s + len(data) * self.byte_s

    def _collide(self, begin_s: float, piece: bytes) -> Firmware | None:
        """Spoil what a board says while the host speaks; return the board, which hears nothing."""
        if not self.byte_s or begin_s >= self._said_until_s:
            return None
        for said in self._outgoing:
            first = int((begin_s - said.begin_s) / self.byte_s)
            for place, byte in enumerate(piece, start=first):
                if said.left <= place < len(said.data):
                    said.data[place] &= byte
        return self._outgoing[-1].board if self._outgoing else None


def _pieces(data: bytes) -> list[bytes]:
    """Cut bytes behind each zero."""
    pieces = [part + b"\0" for part in data.split(b"\0")]
    pieces[-1] = pieces[-1][:-1]
    return [piece for piece in pieces if piece]
