"""Fixtures for tests of drivers: a virtual clock, installed plugins, and the conformance suite."""

from importlib.metadata import EntryPoint

import pytest

from rotemina.drivers.conformance import CHECKS, CheckVerdict
from rotemina.drivers.contract import VirtualClock, registry
from rotemina.drivers.serial_lines.byte_channels import ByteChannel
from rotemina.drivers.serial_lines.serial_port import SerialPort


@pytest.fixture
def clock() -> VirtualClock:
    return VirtualClock(1234.5)


@pytest.fixture
def install_plugins(monkeypatch):
    """Return a function that makes entry points, given by name and value, the only ones."""

    def install(**values):
        points = [EntryPoint(name, value, "a group") for name, value in values.items()]
        monkeypatch.setattr(registry, "entry_points", lambda group: points)

    return install


class BlockableChannel(ByteChannel):
    """A line in memory that takes no bytes while it is blocked."""

    def __init__(self, line):
        self._line = line
        self.is_blocked = False

    def read(self):
        return self._line.read()

    def write(self, data):
        if self.is_blocked:
            return 0
        self._line.write(data)
        return len(data)

    def close(self):
        self._line.close()


class BlockableLines:
    """Serial ports on lines in memory that can be blocked."""

    def __init__(self, open_line, clock):
        self._open_line, self._clock = open_line, clock
        self.channels = []

    def open_port(self, url, baud):
        self.channels.append(BlockableChannel(self._open_line(url, baud)))
        return SerialPort(url, self.channels[-1], self._clock)

    def set_blocked(self, is_blocked):
        for channel in self.channels:
            channel.is_blocked = is_blocked


@pytest.fixture
def make_blockable_lines():
    """Return the class of lines that can be blocked."""
    return BlockableLines


@pytest.fixture
def run_conformance_suite():
    """Return a function that requires that no check of the conformance suite fails.

    Each check gets a new bench from the given function. The names of the skipped checks are
    returned.
    """

    def run(make_bench):
        results = [check.run(make_bench()) for check in CHECKS]
        failures = {
            result.name: f"{result.requirement} {result.note}"
            for result in results
            if result.verdict is CheckVerdict.FAILED
        }
        assert failures == {}
        return {result.name for result in results if result.verdict is CheckVerdict.SKIPPED}

    return run
