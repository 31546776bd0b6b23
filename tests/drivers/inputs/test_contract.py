"""One suite over every kind of input device; what is faked lies below the driver."""

from dataclasses import dataclass, replace
from itertools import groupby
from typing import Any

import pytest

from rotemina.drivers.errors import StateError
from rotemina.drivers.inputs.board import BoardInputs
from rotemina.drivers.inputs.device import InputIdentity, InputLostError
from rotemina.drivers.inputs.pad import Pad
from rotemina.drivers.inputs.script import Moment, Script
from rotemina.drivers.inputs.scripted import Scripted
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.robot.file import load_robot


@dataclass
class Bench:
    """A device with two axes and two buttons, and what a hand can do with it."""

    source: Any
    act: Any  # (axes, buttons): move it
    unplug: Any
    plug: Any


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


def board_bench(request, clock):
    driver = Simulator(load_robot("rotemina"), clock=clock)
    driver.open()
    request.addfinalizer(driver.close)
    driver.set_analog_inputs([0.5, 0.5], [False, False])
    return Bench(
        BoardInputs(lambda: driver, clock=clock),
        lambda axes, buttons: driver.set_analog_inputs([(1 + axis) / 2 for axis in axes], buttons),
        driver.close,
        driver.open,
    )


def scripted_bench(request, clock):
    source = Scripted(Script(("x", "y"), ("start", "mode"), ()), clock=clock)

    def go_on(axes=(0.0, 0.0), buttons=(False, False), plugged=True):
        # The script is written as the test goes.
        clock.advance(0.01)
        moment = Moment(clock() - source.begun_s, tuple(axes), tuple(buttons), plugged)
        source.script = replace(source.script, moments=(*source.script.moments, moment))

    return Bench(source, go_on, lambda: go_on(plugged=False), go_on)


@pytest.fixture(params=[hid_bench, pad_bench, board_bench, scripted_bench])
def bench(request, clock):
    return request.param(request, clock)


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
