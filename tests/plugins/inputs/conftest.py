"""Devices without a window: their looping by hand, on a clock set by hand."""

from math import inf

import pytest

from rotemina.app.motion.teleoperation.input_devices import InputDevices
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.inputs.device import InputIdentity
from rotemina.drivers.inputs.hub import InputHub
from rotemina.drivers.inputs.pad import Pad

ROBOT = ("x", "y", "z", "thx", "thy", "zn")
TICK_S = 0.005


class Stick(Pad):
    """A pad that is taken for a joystick which streams."""

    def __init__(self, clock, label="stick", axes=("X", "Y", "Z"), buttons=("1", "2", "3")):
        super().__init__(label, axes, buttons, lease_s=inf, clock=clock)
        self.identity = InputIdentity(f"hid:046d:c215:{label}", label, "hid")

    @property
    def key(self):
        return self.identity.key


class Bench:
    """Sticks, the devices that are open, and the time."""

    def __init__(self, clock, folder, *sticks):
        self.clock = clock
        self.devices = InputDevices(
            InputHub({one.identity.key: one for one in sticks}), ROBOT, folder
        )
        self.devices.look()
        self.heard = []
        self.devices.listen(self.heard.append)
        self.run()

    def run(self, seconds=0.2):
        """Let the loop run, and return what it heard."""
        del self.heard[:]
        for _ in range(round(seconds / TICK_S)):
            self.clock.advance(TICK_S)
            self.devices.step(self.clock())
        return list(self.heard)

    def view(self, key):
        self.run(0.05)
        return next(v for v in self.devices.view.devices if v.device.identity.key == key)


@pytest.fixture
def clock():
    return VirtualClock(3.0)


@pytest.fixture
def make_stick(clock):
    return lambda *args, **options: Stick(clock, *args, **options)


@pytest.fixture
def make_bench(clock, tmp_path):
    made = []

    def make(*sticks):
        made.append(Bench(clock, tmp_path, *sticks))
        return made[-1]

    yield make
    for bench in made:
        bench.devices.close()
