"""Rules that every kind of input device follows. Only the layer below the driver is faked."""

from dataclasses import dataclass, replace
from importlib.metadata import entry_points
from itertools import cycle, groupby
from typing import Any

import pytest

from rotemina.app.motion.inputs import (
    ActionMapping,
    AxisMapping,
    DeviceMapping,
    InputDevices,
    InputProfile,
    OperatorAction,
)
from rotemina.drivers.contract import DeviceState, DeviceStatus, InputLostError, StateError
from rotemina.drivers.inputs import (
    BoardJoystickSource,
    InputHub,
    InputIdentity,
    InputPad,
)
from rotemina.drivers.inputs.hub import INPUT_GROUP
from rotemina.drivers.inputs.script import InputScript, ScriptMoment
from rotemina.drivers.inputs.scripted import ScriptedSource
from rotemina.drivers.simulator import Simulator
from rotemina.sim.robot_files import load_robot


@dataclass
class Bench:
    """A device with two axes and two buttons, and functions that operate it."""

    source: Any
    # Set the axes and buttons.
    act: Any
    unplug: Any
    plug: Any
    # Break the link of the device unnoticed, if it has one, and restore it.
    break_link: Any = lambda: None
    restore_link: Any = lambda: None


def hid_bench(request, clock):
    hidapi, source = request.getfixturevalue("hidapi"), request.getfixturevalue("hid")
    descriptor = bytes.fromhex(
        "05 01 09 04 A1 01 15 81 25 7F 75 08 95 02 09 30 09 31 81 02"
        "05 09 19 01 29 02 15 00 25 01 75 01 95 02 81 02 75 06 95 01 81 03 C0"
    )

    def act(axes, buttons):
        bits = sum(is_held << number for number, is_held in enumerate(buttons))
        report = [round(127 * axis) & 0xFF for axis in axes]
        hidapi.bus[b"/dev/hidraw0"].waiting.append(bytes([*report, bits]))

    def plug():
        hidapi.plug(b"/dev/hidraw0", descriptor)

    plug()
    return Bench(source, act, hidapi.bus.clear, plug)


def pad_bench(request, clock):
    pad = InputPad("pad", ("x", "y"), ("start", "mode"), clock=clock)

    def act(axes, buttons):
        for name, deflection in zip(pad.axes, axes, strict=True):
            pad.deflect(name, deflection)
        for name, is_held in zip(pad.buttons, buttons, strict=True):
            pad.hold(name, is_held)

    return Bench(pad, act, pad.unplug, pad.plug_in)


class SilentBoard(Simulator):
    """A simulator whose link can break."""

    is_link_broken = False

    def _status(self):
        return (
            DeviceStatus(DeviceState.IDLE, silent_s=0.2)
            if self.is_link_broken
            else super()._status()
        )


def board_bench(request, clock):
    driver = SilentBoard(load_robot("rotemina"), clock=clock)
    driver.open()
    request.addfinalizer(driver.close)
    driver.set_analog_inputs([0.5, 0.5], [False, False])

    def break_link(is_broken=True):
        driver.is_link_broken = is_broken

    return Bench(
        BoardJoystickSource(lambda: driver, clock=clock),
        lambda axes, buttons: driver.set_analog_inputs([(1 + axis) / 2 for axis in axes], buttons),
        driver.close,
        driver.open,
        break_link,
        lambda: break_link(False),
    )


def scripted_bench(request, clock):
    source = ScriptedSource(InputScript(("x", "y"), ("start", "mode"), ()), clock=clock)

    def add_moment(axes=(0.0, 0.0), buttons=(False, False), plugged=True):
        # The test extends the script while it plays.
        clock.advance(0.01)
        moment = ScriptMoment(clock() - source.start_s, tuple(axes), tuple(buttons), plugged)
        source.script = replace(source.script, moments=(*source.script.moments, moment))

    return Bench(source, add_moment, lambda: add_moment(plugged=False), add_moment)


BENCHES = {
    "hid": hid_bench,
    "pad": pad_bench,
    "board": board_bench,
    "scripted": scripted_bench,
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


def test_a_device_is_found_with_its_identity_and_lists_its_controls(bench):
    (identity,) = bench.source.devices()
    assert identity.key.startswith(f"{identity.source}:")
    assert identity.name
    assert bench.source.problem is None
    device = bench.source.open(identity)
    assert bench.source.devices() == (identity,) == (device.identity,)
    assert len(set(device.axes)) == len(set(device.buttons)) == 2


def test_readings_match_the_actions_and_have_the_time_of_the_clock(bench, device, clock):
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


def test_each_reading_comes_once_in_order(bench, device, clock):
    readings = []
    for axis in (0.0, 1.0, -1.0):
        clock.advance(0.1)
        bench.act((axis, 0.0), (False, False))
        readings += device.read()
    assert device.read() == ()
    times_s = [reading.host_time_s for reading in readings]
    assert times_s == sorted(times_s)
    # A pad reports each key separately, even if its state does not change.
    assert [axis for axis, _ in groupby(reading.axes[0] for reading in readings)][-2:] == [1, -1]


def test_an_unplugged_device_stays_lost(bench, device):
    bench.act((1.0, 0.0), (True, True))
    bench.unplug()
    for _ in range(2):
        with pytest.raises(InputLostError, match=device.identity.name.split()[-1]):
            device.read()
    assert bench.source.devices() == ()
    device.close()
    with pytest.raises(InputLostError):
        bench.source.open(device.identity)


def test_a_device_plugged_in_again_has_its_identity_and_can_be_opened(bench, device):
    bench.unplug()
    bench.source.devices()
    bench.plug()
    assert bench.source.devices() == (device.identity,)
    reopened_device = bench.source.open(device.identity)
    bench.act((1.0, 1.0), (False, True))
    assert reopened_device.read()[-1].axes == (1.0, 1.0)
    assert (reopened_device.axes, reopened_device.buttons) == (device.axes, device.buttons)


def test_a_closed_device_cannot_be_read_and_may_be_closed_again(bench, device):
    device.close()
    device.close()
    bench.act((1.0, 0.0), (False, False))
    with pytest.raises(StateError, match="closed"):
        device.read()
    assert bench.source.open(device.identity).axes == device.axes


def test_an_unknown_device_cannot_be_opened(bench):
    bench.source.devices()
    with pytest.raises(InputLostError, match="stranger"):
        bench.source.open(InputIdentity("none:1", "stranger", "none"))


# The following tests check, for every source, that a silent device counts as released.


def test_every_installed_source_is_in_this_suite():
    installed = {point.name for point in entry_points(group=INPUT_GROUP)}
    assert installed
    assert installed <= BENCHES.keys()


REST, PRESSED = ((0.0, 0.0), (False, False)), ((0.0, 0.0), (True, False))
DEFLECTED = ((0.8, 0.0), (True, False))
STEP_S = 0.005


class Operator:
    """An operator who steers x with a device's first axis and its first button as dead-man."""

    def __init__(self, bench, clock, folder):
        self.bench, self.clock = bench, clock
        self.devices = InputDevices(InputHub({"bench": bench.source}), ("x", "y"), folder)
        (identity,) = bench.source.devices()
        self.devices.detect_changes()
        self.intent = self.devices.step(clock()).intent
        device = self.devices.find_device(identity.key)
        axes = (AxisMapping(control=device.axes[0], drives="x"),)
        actions = (ActionMapping(control=device.buttons[0], action=OperatorAction.DEAD_MAN),)
        mapping = DeviceMapping(key=identity.key, axes=axes, actions=actions)
        self.devices.use_profile(InputProfile(name="Test", devices=(mapping,)))

    def run(self, seconds, states=()):
        """Report the states in turn, one at each step. Without states, report nothing."""
        states_in_turn = cycle(states)
        end_s = self.clock() + seconds - 1e-9
        while self.clock() < end_s:
            if states:
                self.bench.act(*next(states_in_turn))
            self.clock.advance(STEP_S)
            self.intent = self.devices.step(self.clock()).intent

    def report_once(self, state):
        """Report a state of the device once."""
        self.bench.act(*state)
        self.run(0.2)

    def drive(self):
        """Begin to steer from rest, with the dead-man pressed first."""
        for state in (REST, PRESSED, DEFLECTED):
            self.report_once(state)
        assert self.is_moving

    @property
    def is_moving(self):
        return self.intent.deflections.get("x", 0.0) != 0.0

    @property
    def is_consenting(self):
        return self.is_moving or OperatorAction.DEAD_MAN in self.intent.held


@pytest.fixture
def operator(bench, clock, tmp_path):
    operator = Operator(bench, clock, tmp_path)
    yield operator
    operator.devices.close()


def check_return_from_rest(operator):
    """Restore the link, and check that the device acts again only from rest and a new press."""
    operator.bench.restore_link()
    operator.devices.detect_changes()
    operator.report_once(DEFLECTED)
    operator.run(0.3, [DEFLECTED])
    assert not operator.is_consenting
    operator.drive()


def test_a_device_without_reports_counts_as_released_within_a_second(operator):
    operator.drive()
    operator.bench.break_link()
    operator.run(0.85)
    assert not operator.is_consenting
    check_return_from_rest(operator)


@pytest.mark.parametrize("noise", [(0.0,), (0.0, 0.01, 0.02, 0.03)])
def test_an_interrupted_stream_counts_as_released_within_300_ms(operator, noise):
    def add_noise(state):
        (x, y), buttons = state
        return [((x + offset, y), buttons) for offset in noise]

    operator.run(1.5, add_noise(REST))
    operator.run(0.2, add_noise(PRESSED))
    operator.run(0.4, add_noise(DEFLECTED))
    assert operator.is_moving
    operator.bench.break_link()
    operator.run(0.3)
    assert not operator.is_consenting
    check_return_from_rest(operator)


@pytest.mark.parametrize("reports", [(), (DEFLECTED,)])
def test_after_a_gap_in_the_programs_clock_the_old_deflection_does_not_act(operator, reports):
    operator.drive()
    for report in reports:
        operator.bench.act(*report)
    operator.clock.advance(30.0)
    operator.run(STEP_S)
    assert not operator.is_consenting
    check_return_from_rest(operator)
