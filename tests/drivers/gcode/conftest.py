"""What tests of the G-code stage share: the driver over a line in memory to an emulated stage."""

import threading

import pytest

from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.conformance.bench import Bench as KitBench
from rotemina.drivers.errors import ConnectionLostError
from rotemina.drivers.gcode.driver import GcodeStage
from rotemina.drivers.gcode.emulator import EmulatedStage
from rotemina.drivers.samples import DeviceState, Samples
from rotemina.sim.robot.file import load_robot


class MemoryPort:
    """A line in memory; threads may write to it while another one reads.

    ``delay_s`` passes each way; ``alter`` changes what the controller says; with ``echo`` what is
    sent comes back too.
    """

    def __init__(self, stage, clock, began_s, delay_s=0.0, alter=None, echo=False):
        self._stage, self._clock, self._began_s = stage, clock, began_s
        self.delay_s, self._echo = delay_s, echo
        self.alter = alter
        self._turn = threading.Lock()
        self._to, self._back = [], []
        self.cut = self.gone = False
        self.written = b""

    def read(self):
        if self.gone:
            raise ConnectionLostError("memory: the port is gone")
        with self._turn:
            now_s = self._deliver()
            data = b""
            while self._back and self._back[0][0] <= now_s:
                data += self._back.pop(0)[1]
        if self.cut:
            return b""
        return self.alter(data) if self.alter is not None else data

    def write(self, data):
        with self._turn:
            self.written += data
            if not self.cut:
                self._to.append((self._clock() - self._began_s + self.delay_s, data))
            self._deliver()

    def _deliver(self):
        now_s = self._clock() - self._began_s
        while self._to and self._to[0][0] <= now_s:
            at_s, data = self._to.pop(0)
            self._stage.receive(data, at_s)
            if self._echo:
                self._back.append((at_s + self.delay_s, data))
        reply = self._stage.advance(now_s)
        if reply:
            self._back.append((now_s + self.delay_s, reply))
        return now_s

    def waiting(self):
        return 0

    def close(self):
        pass


class Bench:
    """A driver that is joined to an emulated stage, whatever drivers come and go."""

    def __init__(self, robot="xyz", settings=None, *, stage=EmulatedStage, line=None, **options):
        self.robot = load_robot(robot) if isinstance(robot, str) else robot
        self.clock = VirtualClock(1234.5)
        self.began_s = self.clock()
        self.stage = stage(self.robot, **options)
        self.line = line or {}
        self.settings = {"port": "memory", **(settings or {})}
        self.ports = []
        self.driver = self.make({})

    def make(self, settings):
        return GcodeStage(
            self.robot,
            {**self.settings, **settings},
            clock=self.clock,
            open_port=self._opened,
            pause=self.clock.advance,
        )

    def _opened(self, _url, _baud):
        self.ports.append(MemoryPort(self.stage, self.clock, self.began_s, **self.line))
        return self.ports[-1]

    @property
    def port(self):
        return self.ports[-1]

    def alter_once(self, change):
        """Change the next status, and only that."""

        def alter(data):
            if b"MPos:" not in data:
                return data
            self.port.alter = None
            return change(data)

        self.port.alter = alter

    def lines_sent(self, since=0):
        """Return the lines that were written, without single bytes."""
        written = self.port.written[since:]
        for byte in (b"?", b"!", b"\x18", b"\x85"):
            written = written.replace(byte, b"")
        return [line.decode() for line in written.split(b"\n") if line]

    def delay(self, seconds):
        self.line = {"delay_s": seconds}
        for port in self.ports:
            port.delay_s = seconds

    def cut(self, is_cut):
        for port in self.ports:
            port.cut = is_cut

    def run(self, seconds, round_s=0.01):
        parts = []
        for _ in range(round(seconds / round_s)):
            self.clock.advance(round_s)
            parts.append(self.driver.read())
        return Samples.joined(parts, len(self.driver.axes))

    def rest(self, limit_s=60.0):
        busy = (DeviceState.MOVING, DeviceState.HOMING)
        parts = [self.run(0.05)]
        for _ in range(round(limit_s / 0.05)):
            if self.driver.status().state not in busy:
                return Samples.joined(parts, len(self.driver.axes))
            parts.append(self.run(0.05))
        raise AssertionError(f"still {self.driver.status()} after {limit_s} s")

    def homed(self):
        self.driver.open()
        self.driver.home(self.driver.homing_axes)
        self.rest()
        assert self.driver.status().position_known
        return self.driver

    def at(self):
        return self.run(0.1).command[-1]

    def kit(self):
        return KitBench(
            make=self.make,
            advance=self.clock.advance,
            cut_link=lambda: self.cut(True),
            restore_link=lambda: self.cut(False),
            misreport=lambda: self.alter_once(lambda data: data.replace(b".", b"", 1)),
            delay_line=self.delay,
            cause_fault=lambda _: self.stage.hit_limit(),
            touched=lambda: bool(self.ports),
        )


@pytest.fixture
def joined():
    """Return the class of joined benches."""
    return Bench
