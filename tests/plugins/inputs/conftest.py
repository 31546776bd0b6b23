"""Input devices without a window, stepped by tests on a virtual clock."""

from math import inf

import pytest

from rotemina.app.motion.inputs import InputDevices
from rotemina.drivers.contract import VirtualClock
from rotemina.drivers.inputs import InputHub, InputIdentity, InputPad

ROBOT = ("x", "y", "z", "thx", "thy", "zn")
TICK_S = 0.005


class StickPad(InputPad):
    """A pad that appears as a streaming joystick."""

    def __init__(self, clock, label="stick", axes=("X", "Y", "Z"), buttons=("1", "2", "3")):
        super().__init__(label, axes, buttons, lease_s=inf, clock=clock)
        self.identity = InputIdentity(f"hid:046d:c215:{label}", label, "hid")

    @property
    def key(self):
        return self.identity.key


class InputBench:
    """Sticks, the opened input devices and a virtual clock."""

    def __init__(self, clock, folder, *sticks):
        self.clock = clock
        self.devices = InputDevices(
            InputHub({stick.identity.key: stick for stick in sticks}), ROBOT, folder
        )
        self.devices.detect_changes()
        self.updates = []
        self.devices.add_listener(self.updates.append)
        self.run()

    def run(self, seconds=0.2):
        """Run the loop, and return the updates that the listener received."""
        del self.updates[:]
        for _ in range(round(seconds / TICK_S)):
            self.clock.advance(TICK_S)
            self.devices.step(self.clock())
        return list(self.updates)

    def view(self, key):
        self.run(0.05)
        return next(view for view in self.devices.view.devices if view.device.identity.key == key)


@pytest.fixture
def clock():
    return VirtualClock(3.0)


@pytest.fixture
def make_stick(clock):
    return lambda *args, **options: StickPad(clock, *args, **options)


@pytest.fixture
def make_bench(clock, tmp_path):
    benches = []

    def make(*sticks):
        benches.append(InputBench(clock, tmp_path, *sticks))
        return benches[-1]

    yield make
    for bench in benches:
        bench.devices.close()
