"""What tests of the boards' driver share: a robot, and the driver joined to virtual boards."""

import pytest

from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.mc68hc11.driver import MC68HC11
from rotemina.drivers.samples import Samples
from rotemina.drivers.virtual_board.boards import VirtualBoards
from rotemina.sim.robot.file import load_robot

ROUND_S = 0.001


class MemoryPort:
    """A line in memory; bytes in either direction may be lost or changed."""

    def __init__(self, line, clock):
        self.line = line
        self.clock = clock
        self.begin_s = clock()
        self.closed = False
        self.cut = False
        self.to_board = self.to_host = staticmethod(lambda data: data)
        self.written = []

    def read(self):
        data = self.line.advance(self.clock() - self.begin_s)
        return b"" if self.cut else self.to_host(data)

    def write(self, data):
        self.written.append((self.clock(), data))
        data = b"" if self.cut else self.to_board(data)
        if data:
            self.line.receive(data, self.clock() - self.begin_s)

    def waiting(self):
        return 0

    def close(self):
        self.closed = True


class Bench:
    """A driver that is joined to virtual boards."""

    def __init__(self, robot, *, ports=2, baud=125_000, settings=None, **boards):
        self.clock = VirtualClock(1234.5)
        boards.setdefault("position_known", True)
        self.boards = VirtualBoards(robot, ports=ports, baud=baud, **boards)
        self.ports = []
        urls = {"port": "first", "baud": baud, "settle_s": 0.05}
        if ports == 2:
            urls["second_port"] = "second"
        self.begin_s = self.clock()
        self.driver = MC68HC11(
            robot,
            {**urls, **(settings or {})},
            clock=self.clock,
            open_port=self._opened,
            pause=self.clock.advance,
        )

    def _opened(self, url, _baud):
        port = MemoryPort(self.boards.lines[0 if url == "first" else 1], self.clock)
        port.begin_s = self.begin_s
        self.ports = [*self.ports[:1], port] if url == "second" else [port]
        return port

    def run(self, seconds, *, round_s=ROUND_S):
        """Let time pass while the driver is served; return what was sampled."""
        parts = []
        for _ in range(round(seconds / round_s)):
            self.clock.advance(round_s)
            parts.append(self.driver.read())
        return Samples.joined(parts, len(self.driver.axes))

    def run_until(self, *states, limit_s=30.0, round_s=ROUND_S):
        """Let time pass until the driver is in one of the states; return what was sampled."""
        parts = [self.driver.read()]
        for _ in range(round(limit_s / round_s)):
            if self.driver.status().state in states:
                return Samples.joined(parts, len(self.driver.axes))
            self.clock.advance(round_s)
            parts.append(self.driver.read())
        raise AssertionError(f"still {self.driver.status()} after {limit_s} s")


@pytest.fixture(scope="session")
def robot():
    return load_robot("rotemina")


@pytest.fixture
def joined_bench():
    """Return a function that joins a driver to virtual boards."""
    return Bench


@pytest.fixture
def memory_port():
    """Return the class of lines in memory."""
    return MemoryPort
