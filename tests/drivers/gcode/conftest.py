"""Fixtures for tests of the G-code stage: the driver, connected in memory to an emulated stage."""

import threading

import pytest

from rotemina.drivers.contract import ConnectionLostError, DeviceSamples, DeviceState, VirtualClock
from rotemina.drivers.gcode import EmulatedStage
from rotemina.drivers.gcode.driver import GcodeStage
from rotemina.sim.robot_files import load_robot


class MemoryPort:
    """A serial line in memory. Several threads may write to it while another thread reads.

    The line delays bytes by ``delay_s`` in each direction. ``alter`` changes the replies of the
    controller. With ``echo``, sent bytes also come back.
    """

    def __init__(self, stage, clock, began_s, delay_s=0.0, alter=None, echo=False):
        self._stage, self._clock, self._began_s = stage, clock, began_s
        self.delay_s, self._echo = delay_s, echo
        self.alter = alter
        self._lock = threading.Lock()
        self._sent, self._replies = [], []
        self.is_cut = self.is_removed = False
        self.written = b""

    def read(self):
        if self.is_removed:
            raise ConnectionLostError("memory: the port is gone")
        with self._lock:
            now_s = self._deliver()
            data = b""
            while self._replies and self._replies[0][0] <= now_s:
                data += self._replies.pop(0)[1]
        if self.is_cut:
            return b""
        return self.alter(data) if self.alter is not None else data

    def write(self, data):
        with self._lock:
            self.written += data
            if not self.is_cut:
                self._sent.append((self._clock() - self._began_s + self.delay_s, data))
            self._deliver()

    def _deliver(self):
        now_s = self._clock() - self._began_s
        while self._sent and self._sent[0][0] <= now_s:
            at_s, data = self._sent.pop(0)
            self._stage.receive(data, at_s)
            if self._echo:
                self._replies.append((at_s + self.delay_s, data))
        reply = self._stage.advance(now_s)
        if reply:
            self._replies.append((now_s + self.delay_s, reply))
        return now_s

    def waiting(self):
        return 0

    def close(self):
        pass


class Bench:
    """A driver connected to an emulated stage. Several drivers can use the stage in turn."""

    def __init__(self, robot="xyz", settings=None, *, stage=EmulatedStage, line=None, **options):
        self.robot = load_robot(robot) if isinstance(robot, str) else robot
        self.clock = VirtualClock(1234.5)
        self.began_s = self.clock()
        self.stage = stage(self.robot, **options)
        self.line = line or {}
        self.settings = {"port": "memory", **(settings or {})}
        self.ports = []
        self.driver = self.make({}, self._open_port)

    def make(self, settings, open_port):
        return GcodeStage(
            self.robot,
            {**self.settings, **settings},
            clock=self.clock,
            open_port=open_port,
            pause=self.clock.advance,
        )

    def _open_port(self, _url, _baud):
        self.ports.append(MemoryPort(self.stage, self.clock, self.began_s, **self.line))
        return self.ports[-1]

    @property
    def port(self):
        return self.ports[-1]

    def alter_once(self, change):
        """Change the next status report only."""

        def alter(data):
            if b"MPos:" not in data:
                return data
            self.port.alter = None
            return change(data)

        self.port.alter = alter

    def lines_sent(self, first_byte=0):
        """Return the written lines, without real-time command bytes."""
        written = self.port.written[first_byte:]
        for byte in (b"?", b"!", b"\x18", b"\x85"):
            written = written.replace(byte, b"")
        return [line.decode() for line in written.split(b"\n") if line]

    def delay(self, seconds):
        self.line = {"delay_s": seconds}
        for port in self.ports:
            port.delay_s = seconds

    def set_cut(self, is_cut):
        for port in self.ports:
            port.is_cut = is_cut

    def run(self, seconds, round_s=0.01):
        portions = []
        for _ in range(round(seconds / round_s)):
            self.clock.advance(round_s)
            portions.append(self.driver.read())
        return DeviceSamples.join(portions, len(self.driver.axes))

    def wait_for_rest(self, limit_s=60.0, round_s=0.01):
        busy = (DeviceState.MOVING, DeviceState.HOMING)
        portions = [self.run(0.05, round_s)]
        for _ in range(round(limit_s / 0.05)):
            if self.driver.status().state not in busy:
                return DeviceSamples.join(portions, len(self.driver.axes))
            portions.append(self.run(0.05, round_s))
        raise AssertionError(f"still {self.driver.status()} after {limit_s} s")

    def home(self):
        self.driver.home(self.driver.homing_axes)
        self.wait_for_rest(round_s=0.05)
        assert self.driver.status().position_known

    def open_and_home(self):
        self.driver.open()
        self.home()
        return self.driver

    def advance_stage(self, seconds=0.0):
        """Let time pass for the stage alone, without the driver."""
        self.clock.advance(seconds)
        return self.stage.advance(self.clock() - self.began_s)

    def send_to_stage(self, data):
        """Send bytes to the stage as another program would."""
        self.stage.receive(data, self.clock() - self.began_s)

    def read_position(self):
        return self.run(0.1).command[-1]


@pytest.fixture
def make_bench():
    """Return the class of benches."""
    return Bench


@pytest.fixture
def bench():
    """Return a bench whose driver is open and homed."""
    bench = Bench()
    bench.open_and_home()
    return bench


@pytest.fixture
def driver(bench):
    return bench.driver
