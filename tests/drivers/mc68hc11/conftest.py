"""Fixtures for tests of the boards' driver: a robot, and the driver connected to virtual boards."""

import os
import shutil

import numpy as np
import pytest

from rotemina.drivers.contract import DeviceSamples, VirtualClock
from rotemina.drivers.mc68hc11.driver import MC68HC11Driver
from rotemina.drivers.mc68hc11.firmware import cycles
from rotemina.drivers.virtual_board import VirtualBoards
from rotemina.sim.records import Record, Tap
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
    """A driver connected to virtual boards. Several drivers can use the boards in turn."""

    def __init__(self, robot, *, ports=2, baud=125_000, settings=None, **boards):
        self.robot = robot
        self.clock = VirtualClock(1234.5)
        self.begin_s = self.clock()
        self.boards = VirtualBoards(
            robot, ports=ports, baud=baud, **{"position_known": True} | boards
        )
        self.ports = []
        self.settings = {"port": "first", "baud": baud, "settle_s": 0.05, **(settings or {})}
        if ports == 2:
            self.settings["second_port"] = "second"
        self.driver = self.make({}, self._open_port)

    def make(self, settings, open_port):
        return MC68HC11Driver(
            self.robot,
            {**self.settings, **settings},
            clock=self.clock,
            open_port=open_port,
            pause=self.clock.advance,
        )

    def _open_port(self, url, _baud):
        port = MemoryPort(self.boards.host_ports[0 if url == "first" else 1], self.clock)
        port.begin_s = self.begin_s
        self.ports = [*self.ports[:1], port] if url == "second" else [port]
        return port

    def set_cut(self, is_cut):
        for port in self.ports:
            port.is_cut = is_cut

    def delay(self, seconds):
        """Delay each byte on the lines, in both directions."""
        for port in self.boards.host_ports:
            port._line.to_board.delay_s = port._line.to_host.delay_s = seconds

    @staticmethod
    def make_wave(rows):
        """Make a trajectory of small waves of zn, with a row every 5 ms."""
        time_s = np.arange(rows) * 0.005
        command = 30e-6 + 1e-6 * np.sin(2 * np.pi * time_s)
        return Record.from_signals(time_s, {("zn", Tap.CMD): command}, {"zn": "m"})

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
def open_bench(robot):
    """Return a function that makes a bench and opens its driver, which is closed after the test."""
    benches = []

    def make_and_open(**options):
        benches.append(Bench(robot, **options))
        benches[-1].driver.open()
        return benches[-1]

    yield make_and_open
    for bench in benches:
        bench.driver.close()


@pytest.fixture
def bench(open_bench):
    """Return a bench with two lines, whose driver is open."""
    bench = open_bench()
    bench.run(0.1)
    return bench


@pytest.fixture(scope="session")
def assembler():
    """Skip the test if the assembler of the firmware is not installed."""
    if shutil.which(cycles.ASSEMBLER) is None:
        message = f"no {cycles.ASSEMBLER}: `make test` installs {cycles.ASSEMBLER_PACKAGE}"
        if os.environ.get("CI") == "true":
            pytest.fail(message)
        pytest.skip(message)
