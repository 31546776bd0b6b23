"""A host for the virtual boards, on a clock of its own: it says frames and reads answers."""

from types import SimpleNamespace

import pytest

from rotemina.drivers.mc68hc11 import board_messages, host_messages
from rotemina.drivers.mc68hc11.board_messages import Refused, Telemetry
from rotemina.drivers.mc68hc11.framing import Decoder, Frame, encoded
from rotemina.drivers.virtual_board.boards import VirtualBoards
from rotemina.sim.robot.file import load_robot

_REPORTS = {
    kind.TYPE: kind
    for kind in (
        board_messages.Done,
        board_messages.Refused,
        board_messages.Identity,
        board_messages.AxisDescription,
        board_messages.Telemetry,
        board_messages.Captured,
        board_messages.Parameter,
        board_messages.Rates,
        board_messages.BoardKind,
        board_messages.Inputs,
    )
}
_STEP_S = 1e-3


class Host:
    """Talks to boards; ``heard`` is all that it was told: (board, message, time in s)."""

    def __init__(self, robot, **settings):
        self.boards = VirtualBoards(robot, **{"position_known": True} | settings)
        self.time_s = 0.0
        self.number = 0
        self.heard = []
        self._decoders = [Decoder() for _ in self.boards.lines]

    def wire(self, message, board=1, number=None):
        if number is None:
            self.number = number = (self.number + 1) % 256
        return encoded(Frame(board, number, message.TYPE, message.packed()))

    def line(self, board):
        return self.boards.lines[0 if len(self.boards.lines) == 1 else board - 1]

    def say(self, message, board=1, number=None):
        self.write(self.wire(message, board, number), board)

    def write(self, data, board=1):
        self.line(board).receive(data, self.time_s)

    def live(self, duration_s):
        """Live on in small steps; return the messages that came."""
        before = len(self.heard)
        end_s = self.time_s + duration_s
        while self.time_s < end_s - 1e-9:
            self.time_s = min(self.time_s + _STEP_S, end_s)
            for decoder, line in zip(self._decoders, self.boards.lines, strict=True):
                for frame in decoder.feed(line.advance(self.time_s)):
                    message = _REPORTS[frame.type].unpacked(frame.payload)
                    self.heard.append((frame.address, message, self.time_s))
        return [message for _, message, _ in self.heard[before:]]

    def ask(self, message, board=1, number=None, within_s=0.02):
        """Say something and return what that board answers first."""
        before = len(self.heard)
        self.say(message, board, number)
        self.live(within_s)
        return next((m for who, m, _ in self.heard[before:] if who == board), None)

    def refusal(self, message, board=1):
        answer = self.ask(message, board)
        assert isinstance(answer, Refused), answer
        return answer.reason

    def telemetry(self, board=1):
        answer = self.ask(host_messages.Poll(), board)
        return answer if isinstance(answer, Telemetry) else self.ask(host_messages.Poll(), board)

    def commands(self, board=1):
        return [command for _, command in self.telemetry(board).samples()]

    def now_us(self, board=1):
        self.live(1e-3)
        one = self.boards.boards[board - 1]
        return one.clock.at_tick(one.now)

    def patient(self):
        """Let no watchdog bite."""
        for board in self.boards.boards:
            self.say(host_messages.Watch(60_000), board.number)
        self.live(0.02)
        return self


@pytest.fixture(scope="session")
def robot():
    return load_robot("rotemina")


@pytest.fixture
def host(robot):
    return Host(robot).patient()


@pytest.fixture
def hosts(robot):
    return lambda **settings: Host(settings.pop("robot", robot), **settings)


@pytest.fixture(scope="session")
def one_board():
    return SimpleNamespace(fsm=load_robot("fsm"), emps=load_robot("emps"))
