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
    """A line in memory; threads may write to it while another one reads."""

    def __init__(self, stage, clock, began_s):
        self._stage, self._clock, self._began_s = stage, clock, began_s
        self._turn = threading.Lock()
        self.cut = self.gone = False
        self.written = b""

    def read(self):
        if self.gone:
            raise ConnectionLostError("memory: the port is gone")
        with self._turn:
            data = self._stage.advance(self._clock() - self._began_s)
        return b"" if self.cut else data

    def write(self, data):
        with self._turn:
            self.written += data
            if not self.cut:
                self._stage.receive(data, self._clock() - self._began_s)

    def waiting(self):
        return 0

    def close(self):
        pass


class Bench:
    """A driver that is joined to an emulated stage, whatever drivers come and go."""

    def __init__(self, robot="xyz", settings=None, **stage):
        self.robot = load_robot(robot) if isinstance(robot, str) else robot
        self.clock = VirtualClock(1234.5)
        self.began_s = self.clock()
        self.stage = EmulatedStage(self.robot, **stage)
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
        self.ports.append(MemoryPort(self.stage, self.clock, self.began_s))
        return self.ports[-1]

    @property
    def port(self):
        return self.ports[-1]

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
            cause_fault=lambda _: self.stage.hit_limit(),
            touched=lambda: bool(self.ports),
        )


@pytest.fixture
def joined():
    """Return the class of joined benches."""
    return Bench
