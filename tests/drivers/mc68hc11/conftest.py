"""Fixtures for tests of the boards' driver: a robot, and the driver connected to virtual boards."""

import pytest

from rotemina.drivers.contract import DeviceSamples, VirtualClock
from rotemina.drivers.mc68hc11.driver import MC68HC11Driver
from rotemina.drivers.virtual_board import VirtualBoards
from rotemina.sim.robot_files import load_robot

ROUND_S = 0.001


class MemoryPort:
    """A serial line in memory. A test may drop or change bytes in both directions."""

    def __init__(self, line, clock):
        self.line = line
        self.clock = clock
        self.begin_s = clock()
        self.is_closed = False
        self.is_cut = False
        self.to_board = self.to_host = staticmethod(lambda data: data)
        self.written = []

    def read(self):
        data = self.line.advance(self.clock() - self.begin_s)
        return b"" if self.is_cut else self.to_host(data)

    def write(self, data):
        self.written.append((self.clock(), data))
        data = b"" if self.is_cut else self.to_board(data)
        if data:
            self.line.receive(data, self.clock() - self.begin_s)

    def waiting(self):
        return 0

    def close(self):
        self.is_closed = True


class Bench:
    """A driver connected to virtual boards."""

    def __init__(self, robot, *, ports=2, baud=125_000, settings=None, **boards):
        self.clock = VirtualClock(1234.5)
        boards.setdefault("position_known", True)
        self.boards = VirtualBoards(robot, ports=ports, baud=baud, **boards)
        self.ports = []
        urls = {"port": "first", "baud": baud, "settle_s": 0.05}
        if ports == 2:
            urls["second_port"] = "second"
        self.begin_s = self.clock()
        self.driver = MC68HC11Driver(
            robot,
            {**urls, **(settings or {})},
            clock=self.clock,
            open_port=self._open_port,
            pause=self.clock.advance,
        )

    def _open_port(self, url, _baud):
        port = MemoryPort(self.boards.host_ports[0 if url == "first" else 1], self.clock)
        port.begin_s = self.begin_s
        self.ports = [*self.ports[:1], port] if url == "second" else [port]
        return port

    def run(self, seconds, *, round_s=ROUND_S):
        """Let time pass while the driver is read; return the samples."""
        portions = []
        for _ in range(round(seconds / round_s)):
            self.clock.advance(round_s)
            portions.append(self.driver.read())
        return DeviceSamples.join(portions, len(self.driver.axes))

    def run_until(self, *states, limit_s=30.0, round_s=ROUND_S):
        """Let time pass until the driver is in one of the states; return the samples."""
        portions = [self.driver.read()]
        for _ in range(round(limit_s / round_s)):
            if self.driver.status().state in states:
                return DeviceSamples.join(portions, len(self.driver.axes))
            self.clock.advance(round_s)
            portions.append(self.driver.read())
        raise AssertionError(f"still {self.driver.status()} after {limit_s} s")


@pytest.fixture(scope="session")
def robot():
    return load_robot("rotemina")


@pytest.fixture
def make_bench():
    """Return the class of benches."""
    return Bench


@pytest.fixture
def memory_port():
    """Return the class of serial lines in memory."""
    return MemoryPort
