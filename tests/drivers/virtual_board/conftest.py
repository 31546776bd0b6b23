"""A host for the virtual boards with its own clock, which sends frames and reads replies."""

import pytest

from rotemina.drivers.mc68hc11.protocol import (
    FrameDecoder,
    FrameRefused,
    SerialFrame,
    Telemetry,
    encode_frame,
    host_messages,
    unpack_message,
)
from rotemina.drivers.virtual_board import VirtualBoards
from rotemina.sim.robot_files import load_robot

_STEP_S = 1e-3


class Host:
    """A host of boards. ``received`` contains all replies as (board, message, time in s)."""

    def __init__(self, robot, **settings):
        self.boards = VirtualBoards(robot, **{"position_known": True} | settings)
        self.time_s = 0.0
        self.number = 0
        self.received = []
        self._decoders = [FrameDecoder() for _ in self.boards.host_ports]

    def encode(self, message, board=1, number=None):
        if number is None:
            self.number = number = (self.number + 1) % 256
        return encode_frame(SerialFrame(board, number, message.TYPE, message.pack()))

    def find_port(self, board):
        return self.boards.host_ports[0 if len(self.boards.host_ports) == 1 else board - 1]

    def send(self, message, board=1, number=None):
        self.write(self.encode(message, board, number), board)

    def write(self, data, board=1):
        self.find_port(board).receive(data, self.time_s)

    def run(self, duration_s):
        """Let time pass in small steps, and return the received messages."""
        first = len(self.received)
        end_s = self.time_s + duration_s
        while self.time_s < end_s - 1e-9:
            self.time_s = min(self.time_s + _STEP_S, end_s)
            for decoder, port in zip(self._decoders, self.boards.host_ports, strict=True):
                for frame in decoder.feed(port.advance(self.time_s)):
                    message = unpack_message(frame.type, frame.payload)
                    self.received.append((frame.address, message, self.time_s))
        return [message for _, message, _ in self.received[first:]]

    def ask(self, message, board=1, number=None, within_s=0.02):
        """Send a message, and return the first reply of that board."""
        first = len(self.received)
        self.send(message, board, number)
        self.run(within_s)
        replies = (reply for address, reply, _ in self.received[first:] if address == board)
        return next(replies, None)

    def find_refusal_reason(self, message, board=1):
        answer = self.ask(message, board)
        assert isinstance(answer, FrameRefused), answer
        return answer.reason

    def read_telemetry(self, board=1):
        answer = self.ask(host_messages.PollBoard(), board)
        return (
            answer if isinstance(answer, Telemetry) else self.ask(host_messages.PollBoard(), board)
        )

    def read_commands(self, board=1):
        return [command for _, command in self.read_telemetry(board).unpack_samples()]

    def read_time_us(self, board=1):
        self.run(1e-3)
        simulated_board = self.boards.boards[board - 1]
        return simulated_board.clock.find_time_us(simulated_board.latest_tick)

    def with_long_watchdogs(self):
        """Set long watchdog time-outs, so that none expires, and return the host."""
        for board in self.boards.boards:
            self.send(host_messages.SetWatchdog(60_000), board.number)
        self.run(0.02)
        return self


@pytest.fixture(scope="session")
def robot():
    return load_robot("rotemina")


@pytest.fixture
def host(robot):
    return Host(robot).with_long_watchdogs()


@pytest.fixture
def make_host(robot):
    return lambda **settings: Host(settings.pop("robot", robot), **settings)
