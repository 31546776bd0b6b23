"""Detecting, opening, reading and losing input devices, and their reports to the arbiter."""

import threading

import pytest

from rotemina.app.motion.inputs import (
    AxisMapping,
    DeviceMapping,
    InputDevices,
    InputProfile,
    OperatorAction,
    OperatorRole,
    PluggedDevice,
)
from rotemina.app.motion.inputs.input_devices import make_automatic_profile
from rotemina.drivers.contract import VirtualClock
from rotemina.drivers.inputs import InputHub, InputIdentity, InputPad

ROBOT = ("x", "y", "z", "thx", "thy", "zn")
TICK_S = 0.005


@pytest.fixture
def clock():
    return VirtualClock(3.0)


def make_pad(clock, label="pad", buttons=("stop", "stage")):
    return InputPad(label, buttons=buttons, clock=clock)


class Stick(InputPad):
    """A pad that identifies itself as a joystick."""

    def __init__(self, label, clock):
        super().__init__(label, buttons=("stop", "take_over"), clock=clock)
        self.identity = InputIdentity(f"hid:{label}", label, "hid")


@pytest.fixture
def stick(clock):
    return Stick("stick", clock)


@pytest.fixture
def make_devices(clock, tmp_path):
    created = []

    def make_devices(*sources):
        hub = InputHub({source.identity.key: source for source in sources})
        devices = InputDevices(hub, ROBOT, tmp_path)
        created.append(devices)
        devices.detect_changes()
        return devices

    yield make_devices
    for devices in created:
        devices.close()


def run(devices, clock, seconds=0.3):
    for _ in range(round(seconds / TICK_S)):
        clock.advance(TICK_S)
        update = devices.step(clock())
    return update


def test_a_device_drives_after_it_was_at_rest(make_devices, clock, stick):
    devices = make_devices(stick)
    assert run(devices, clock).intent.deflections == {"x": 0.0, "y": 0.0, "z": 0.0}
    stick.deflect("x", 1.0)
    update = run(devices, clock, TICK_S)
    assert update.intent.deflections["x"] == 1.0
    assert update.intent.device == "hid:stick"
    assert update.readings["hid:stick"][-1].axes == (1.0, 0.0, 0.0)
    assert devices.profile.name == "Automatic"
    assert devices.view.problems == ()


def test_an_unplugged_device_is_lost_once_and_must_be_at_rest_after_replugging(
    make_devices, clock, stick
):
    devices = make_devices(stick)
    run(devices, clock)
    stick.unplug()
    intent = run(devices, clock, TICK_S).intent
    assert "was removed" in intent.loss_reason
    assert intent.deflections == {}
    assert run(devices, clock, TICK_S).intent.loss_reason is None
    stick.plug_in()
    stick.deflect("x", 0.8)
    devices.detect_changes()
    assert "x" not in run(devices, clock).intent.deflections
    stick.deflect("x", 0.0)
    assert run(devices, clock).intent.deflections["x"] == 0.0


def test_a_joystick_has_priority_over_the_pad_which_may_take_over(make_devices, clock, stick):
    pad = make_pad(clock, buttons=("stop", "take_over"))
    devices = make_devices(pad)
    run(devices, clock)
    assert devices.profile.devices[0].key == "keys:pad"
    devices.hub._sources["hid:stick"] = stick  # plugged in later
    devices.detect_changes()
    run(devices, clock)
    assert [(device.key, device.seat) for device in devices.profile.devices] == [
        ("hid:stick", OperatorRole.TRAINER),
        ("keys:pad", OperatorRole.TRAINEE),
    ]
    pad.deflect("x", 1.0)
    assert run(devices, clock).intent.deflections["x"] == 0.0
    pad.release_all()
    pad.hold("take_over")
    run(devices, clock)
    pad.hold("take_over", False)
    pad.deflect("x", 1.0)
    assert run(devices, clock).intent.device == "keys:pad"
    pad.hold("stop")
    assert OperatorAction.STOP in run(devices, clock, 0.1).intent.held
    stick.unplug()
    devices.detect_changes()
    run(devices, clock)
    assert devices.profile.devices[0].key == "keys:pad"
    assert devices.profile.devices[0].seat is OperatorRole.TRAINER


def test_a_saved_profile_that_fits_is_used_automatically(make_devices, clock, stick):
    saved_profile = InputProfile(
        name="Mine",
        devices=(DeviceMapping(key="hid:st*", axes=(AxisMapping(control="x", drives="zn"),)),),
    )
    first_devices = make_devices(stick)
    first_devices.save_profile(saved_profile)
    first_devices.close()
    devices = make_devices(stick)
    assert run(devices, clock).intent.deflections == {"zn": 0.0}
    assert devices.profile == saved_profile


def test_a_chosen_profile_stays_until_another_one_is_chosen(make_devices, clock, stick):
    other = InputProfile(
        name="Elsewhere",
        devices=(DeviceMapping(key="hid:other", axes=(AxisMapping(control="x", drives="x"),)),),
    )
    devices = make_devices(stick)
    run(devices, clock)
    devices.use_profile(other)
    assert run(devices, clock).intent.deflections == {}
    assert any("hid:other" in problem for problem in devices.view.problems)
    devices.use_profile(None)
    assert run(devices, clock).intent.deflections["x"] == 0.0


def test_a_device_that_raises_an_error_is_dropped_and_the_others_continue(
    make_devices, clock, stick
):
    pad = make_pad(clock)
    devices = make_devices(stick, pad)
    run(devices, clock)

    def raise_error():
        raise RuntimeError("a bug of a plugin")

    devices.find_device("hid:stick").read = raise_error
    intent = run(devices, clock, TICK_S).intent
    assert "a bug of a plugin" in intent.loss_reason
    assert run(devices, clock).intent.deflections["x"] == 0.0  # the pad drives now
    assert [view.device.identity.key for view in devices.view.devices] == ["keys:pad"]
    devices.detect_changes()
    run(devices, clock)
    assert {view.device.identity.key for view in devices.view.devices} == {"hid:stick", "keys:pad"}


def test_a_calibration_is_used_and_saved(make_devices, clock, stick):
    devices = make_devices(stick)
    run(devices, clock)
    calibration = devices.calibrations.load_or_default(stick.identity)
    inverted = calibration.with_axes({"x": calibration.find_axis("x").__class__(inverted=True)})
    devices.use_calibration("hid:stick", inverted)
    run(devices, clock)
    stick.deflect("x", 1.0)
    assert run(devices, clock, TICK_S).intent.deflections["x"] == -1.0
    assert devices.calibrations.read(stick.identity) == inverted


def test_other_threads_do_not_wait_while_a_device_is_opened(make_devices, clock, stick):
    devices = make_devices(stick)
    open_stick = stick.open

    def open_slowly(identity):
        thread = threading.Thread(target=devices.open_mapping, daemon=True)
        thread.start()
        thread.join(5.0)
        assert not thread.is_alive()
        return open_stick(identity)

    stick.open = open_slowly
    run(devices, clock, TICK_S)
    assert devices.view.is_mapping_open
    assert [device.device.identity.key for device in devices.view.devices] == ["hid:stick"]


def test_a_device_that_turns_out_to_stream_is_lost_when_silent(make_devices, clock, stick):
    devices = make_devices(stick)
    run(devices, clock)
    assert not devices.arbiter.device_views[0].device.streams
    devices.find_device("hid:stick").streams = True
    run(devices, clock, TICK_S)
    assert devices.arbiter.device_views[0].device.streams
    run(devices, clock, 0.5)
    assert "silent: a streaming device" in devices.view.devices[0].problem


def test_without_devices_there_is_no_profile(make_devices, clock):
    assert make_automatic_profile(()) is None
    device = PluggedDevice(InputIdentity("hid:0", "nothing", "hid"), (), ())
    assert make_automatic_profile([device]) is None
    devices = make_devices()
    assert run(devices, clock).intent.deflections == {}
    assert devices.profile is None
