"""One suite over every kind of input device; what is faked lies below the driver."""

from dataclasses import dataclass, replace
from importlib.metadata import entry_points
from itertools import cycle, groupby
from typing import Any

import pytest

from rotemina.app.motion.teleoperation.input_devices import InputDevices
from rotemina.app.motion.teleoperation.intent import Action
from rotemina.app.motion.teleoperation.profile import (
    ActionMapping,
    AxisMapping,
    DeviceMapping,
    Profile,
)
from rotemina.drivers.errors import StateError
from rotemina.drivers.inputs.board import BoardInputs
from rotemina.drivers.inputs.device import (
    InputDevice,
    InputIdentity,
    InputLostError,
    InputReading,
    InputSource,
)
from rotemina.drivers.inputs.hub import INPUTS, InputHub
from rotemina.drivers.inputs.pad import Pad
from rotemina.drivers.inputs.script import Moment, Script
from rotemina.drivers.inputs.scripted import Scripted
from rotemina.drivers.samples import DeviceState, DeviceStatus
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.robot.file import load_robot


@dataclass
class Bench:
    """A device with two axes and two buttons, and what a hand can do with it."""

    source: Any
    act: Any  # (axes, buttons): move it
    unplug: Any
    plug: Any
    # Let its link fail unnoticed, beyond that no hand does anything; and mend it.
    fail: Any = lambda: None
    mend: Any = lambda: None


def hid_bench(request, clock):
    hidapi, source = request.getfixturevalue("hidapi"), request.getfixturevalue("hid")
    descriptor = bytes.fromhex(
        "05 01 09 04 A1 01 15 81 25 7F 75 08 95 02 09 30 09 31 81 02"
        "05 09 19 01 29 02 15 00 25 01 75 01 95 02 81 02 75 06 95 01 81 03 C0"
    )

    def act(axes, buttons):
        bits = sum(held << number for number, held in enumerate(buttons))
        report = [round(127 * axis) & 0xFF for axis in axes]
        hidapi.bus[b"/dev/hidraw0"].waiting.append(bytes([*report, bits]))

    def plug():
        hidapi.plug(b"/dev/hidraw0", descriptor)

    plug()
    return Bench(source, act, hidapi.bus.clear, plug)


def pad_bench(request, clock):
    pad = Pad("pad", ("x", "y"), ("start", "mode"), clock=clock)

    def act(axes, buttons):
        for name, deflection in zip(pad.axes, axes, strict=True):
            pad.deflect(name, deflection)
        for name, held in zip(pad.buttons, buttons, strict=True):
            pad.hold(name, held)

    return Bench(pad, act, pad.withdraw, pad.offer)


class SilentBoard(Simulator):
    """A simulator whose line may fail."""

    failed = False

    def _status(self):
        return DeviceStatus(DeviceState.IDLE, silent_s=0.2) if self.failed else super()._status()


def board_bench(request, clock):
    driver = SilentBoard(load_robot("rotemina"), clock=clock)
    driver.open()
    request.addfinalizer(driver.close)
    driver.set_analog_inputs([0.5, 0.5], [False, False])

    def fail(failed=True):
        driver.failed = failed

    return Bench(
        BoardInputs(lambda: driver, clock=clock),
        lambda axes, buttons: driver.set_analog_inputs([(1 + axis) / 2 for axis in axes], buttons),
        driver.close,
        driver.open,
        fail,
        lambda: fail(False),
    )


def scripted_bench(request, clock):
    source = Scripted(Script(("x", "y"), ("start", "mode"), ()), clock=clock)

    def go_on(axes=(0.0, 0.0), buttons=(False, False), plugged=True):
        # The script is written as the test goes.
        clock.advance(0.01)
        moment = Moment(clock() - source.begun_s, tuple(axes), tuple(buttons), plugged)
        source.script = replace(source.script, moments=(*source.script.moments, moment))

    return Bench(source, go_on, lambda: go_on(plugged=False), go_on)


class Plain(InputSource):
    """A source as a third party would write it first."""

    def __init__(self, *, clock):
        super().__init__(clock=clock)
        self.identity = InputIdentity("plain:1", "Plain stick", "plain")
        self.there = True
        self.waiting = []

    def devices(self):
        return (self.identity,) if self.there else ()

    def open(self, identity):
        if identity not in self.devices():
            raise InputLostError(f"{identity.name} has gone")
        self.waiting.clear()
        return PlainDevice(self)


class PlainDevice(InputDevice):
    axes = ("left", "right")
    buttons = ("press", "twist")

    def __init__(self, source):
        self.identity, self._source, self._is_open = source.identity, source, True

    def read(self):
        if not self._is_open:
            raise StateError("closed; open it again")
        if not self._source.there:
            self._source.waiting.clear()
            raise InputLostError(f"{self.identity.name} has gone")
        readings = tuple(self._source.waiting)
        self._source.waiting.clear()
        return readings

    def close(self):
        self._is_open = False


def plugin_bench(request, clock):
    source = Plain(clock=clock)

    def act(axes, buttons):
        source.waiting.append(InputReading(clock(), tuple(axes), tuple(buttons)))

    def plug(there=True):
        source.there = there

    return Bench(source, act, lambda: plug(False), plug)


BENCHES = {
    "hid": hid_bench,
    "pad": pad_bench,
    "board": board_bench,
    "scripted": scripted_bench,
    "plugin": plugin_bench,
}


@pytest.fixture(params=BENCHES)
def bench(request, clock):
    return BENCHES[request.param](request, clock)


@pytest.fixture
def device(bench):
    (identity,) = bench.source.devices()
    device = bench.source.open(identity)
    device.read()
    return device


def test_a_device_is_found_with_a_key_a_name_and_its_source(bench):
    (identity,) = bench.source.devices()
    assert identity.key.startswith(f"{identity.source}:")
    assert identity.name
    assert bench.source.problem is None
    assert bench.source.devices() == (identity,)


def test_an_open_device_says_what_it_has(bench, device):
    assert bench.source.devices() == (device.identity,)
    assert len(set(device.axes)) == len(set(device.buttons)) == 2


def test_readings_are_what_was_done_stamped_by_the_clock(bench, device, clock):
    clock.advance(1.0)
    before_s = clock()
    bench.act((1.0, -1.0), (True, False))
    latest = device.read()[-1]
    assert latest.axes == (1.0, -1.0)
    assert latest.buttons == (True, False)
    assert before_s <= latest.host_time_s <= clock()
    bench.act((0.0, 1.0), (False, True))
    latest = device.read()[-1]
    assert latest.axes == (0.0, 1.0)
    assert latest.buttons == (False, True)


def test_readings_come_once_oldest_first(bench, device, clock):
    readings = []
    for axis in (0.0, 1.0, -1.0):
        clock.advance(0.1)
        bench.act((axis, 0.0), (False, False))
        readings += device.read()
    assert device.read() == ()
    times_s = [reading.host_time_s for reading in readings]
    assert times_s == sorted(times_s)
    # A pad tells each key by itself, also where nothing changes by it.
    assert [axis for axis, _ in groupby(reading.axes[0] for reading in readings)][-2:] == [1, -1]


def test_unplugging_is_an_error_that_stays(bench, device):
    bench.act((1.0, 0.0), (True, True))
    bench.unplug()
    for _ in range(2):
        with pytest.raises(InputLostError, match=device.identity.name.split()[-1]):
            device.read()
    assert bench.source.devices() == ()
    device.close()
    with pytest.raises(InputLostError):
        bench.source.open(device.identity)


def test_plugged_in_again_it_is_known_and_can_be_opened(bench, device):
    bench.unplug()
    bench.source.devices()
    bench.plug()
    assert bench.source.devices() == (device.identity,)
    again = bench.source.open(device.identity)
    bench.act((1.0, 1.0), (False, True))
    assert again.read()[-1].axes == (1.0, 1.0)
    assert (again.axes, again.buttons) == (device.axes, device.buttons)


def test_closing_is_safe_twice_and_ends_reading(bench, device):
    device.close()
    device.close()
    bench.act((1.0, 0.0), (False, False))
    with pytest.raises(StateError, match="closed"):
        device.read()
    assert bench.source.open(device.identity).axes == device.axes


def test_what_is_not_there_cannot_be_opened(bench):
    bench.source.devices()
    with pytest.raises(InputLostError, match="stranger"):
        bench.source.open(InputIdentity("none:1", "stranger", "none"))


# Silence is never consent: through what all sources have in common, whatever they are.


def test_every_installed_source_is_in_this_suite():
    installed = {point.name for point in entry_points(group=INPUTS)}
    assert installed
    assert installed <= BENCHES.keys()


REST, PRESSED = ((0.0, 0.0), (False, False)), ((0.0, 0.0), (True, False))
DEFLECTED = ((0.8, 0.0), (True, False))
STEP_S = 0.005


class Operator:
    """Who steers x by the first axis of a device, with its first button as the dead-man."""

    def __init__(self, bench, clock, folder):
        self.bench, self.clock = bench, clock
        self.devices = InputDevices(InputHub({"bench": bench.source}), ("x", "y"), folder)
        (identity,) = bench.source.devices()
        self.devices.look()
        self.intent = self.devices.step(clock()).intent
        device = self.devices.device(identity.key)
        axes = (AxisMapping(control=device.axes[0], drives="x"),)
        actions = (ActionMapping(control=device.buttons[0], action=Action.DEAD_MAN),)
        mapping = DeviceMapping(key=identity.key, axes=axes, actions=actions)
        self.devices.use(Profile(name="Test", devices=(mapping,)))

    def run(self, seconds, states=()):
        """Take the states in turn, one at each step; without any, do nothing."""
        turns = cycle(states)
        end_s = self.clock() + seconds - 1e-9
        while self.clock() < end_s:
            if states:
                self.bench.act(*next(turns))
            self.clock.advance(STEP_S)
            self.intent = self.devices.step(self.clock()).intent

    def do(self, state):
        """Bring the device into a state, reported once."""
        self.bench.act(*state)
        self.run(0.2)

    def drive(self):
        """Begin to steer as it should be done."""
        for state in (REST, PRESSED, DEFLECTED):
            self.do(state)
        assert self.moves

    @property
    def moves(self):
        return self.intent.deflections.get("x", 0.0) != 0.0

    @property
    def consents(self):
        return self.moves or Action.DEAD_MAN in self.intent.held


@pytest.fixture
def operator(bench, clock, tmp_path):
    operator = Operator(bench, clock, tmp_path)
    yield operator
    operator.devices.close()


def returns_only_from_rest(operator):
    """Mend the device, and check that it acts again only from its centre and a new press."""
    operator.bench.mend()
    operator.devices.look()
    operator.do(DEFLECTED)
    operator.run(0.3, [DEFLECTED])
    assert not operator.consents
    operator.drive()


def test_held_still_without_a_report_it_counts_as_released_within_a_second(operator):
    operator.drive()
    operator.bench.fail()
    operator.run(0.85)
    assert not operator.consents
    returns_only_from_rest(operator)


@pytest.mark.parametrize("noise", [(0.0,), (0.0, 0.008, -0.008), (0.0, 0.01, 0.02, 0.03)])
def test_a_stream_that_breaks_off_counts_as_released_within_300_ms(operator, noise):
    def noisy(state):
        (x, y), buttons = state
        return [((x + stray, y), buttons) for stray in noise]

    operator.run(1.5, noisy(REST))
    operator.run(0.2, noisy(PRESSED))
    operator.run(0.4, noisy(DEFLECTED))
    assert operator.moves
    operator.bench.fail()
    operator.run(0.3)
    assert not operator.consents
    returns_only_from_rest(operator)


@pytest.mark.parametrize("reports", [(), (DEFLECTED,)])
def test_after_a_gap_in_the_programs_clock_the_old_deflection_does_not_act(operator, reports):
    operator.drive()
    for report in reports:
        operator.bench.act(*report)
    operator.clock.advance(30.0)
    operator.run(STEP_S)
    assert not operator.consents
    returns_only_from_rest(operator)
