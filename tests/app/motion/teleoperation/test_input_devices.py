"""Input devices found, opened, read and lost, with the arbiter told of it all."""

import threading

import pytest

from rotemina.app.motion.teleoperation.input_devices import InputDevices, automatic_profile
from rotemina.app.motion.teleoperation.intent import Action
from rotemina.app.motion.teleoperation.profile import (
    AxisMapping,
    DeviceMapping,
    OperatorRole,
    Profile,
    ProfileError,
)
from rotemina.app.motion.teleoperation.profile_check import PluggedDevice
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.inputs.device import InputIdentity
from rotemina.drivers.inputs.hub import InputHub
from rotemina.drivers.inputs.pad import Pad

ROBOT = ("x", "y", "z", "thx", "thy", "zn")
TICK_S = 0.005


@pytest.fixture
def clock():
    return VirtualClock(3.0)


def pad(clock, label="pad", buttons=("stop", "stage")):
    return Pad(label, buttons=buttons, clock=clock)


class Stick(Pad):
    """A pad that is taken for a joystick."""

    def __init__(self, label, clock):
        super().__init__(label, buttons=("stop", "take_over"), clock=clock)
        self.identity = InputIdentity(f"hid:{label}", label, "hid")


@pytest.fixture
def stick(clock):
    return Stick("stick", clock)


@pytest.fixture
def make(clock, tmp_path):
    made = []

    def make(*sources):
        hub = InputHub({source.identity.key: source for source in sources})
        devices = InputDevices(hub, ROBOT, tmp_path)
        made.append(devices)
        devices.look()
        return devices

    yield make
    for devices in made:
        devices.close()


def run(devices, clock, seconds=0.3):
    for _ in range(round(seconds / TICK_S)):
        clock.advance(TICK_S)
        heard = devices.step(clock())
    return heard


def test_a_device_that_is_there_drives_when_seen_at_rest(make, clock, stick):
    devices = make(stick)
    assert run(devices, clock).intent.deflections == {"x": 0.0, "y": 0.0, "z": 0.0}
    stick.deflect("x", 1.0)
    heard = run(devices, clock, TICK_S)
    assert heard.intent.deflections["x"] == 1.0
    assert heard.intent.device == "hid:stick"
    assert heard.readings["hid:stick"][-1].axes == (1.0, 0.0, 0.0)
    assert devices.profile.name == "Automatic"
    assert devices.view.problems == ()


def test_unplugged_it_is_lost_once_and_replugged_it_must_be_seen_at_rest(make, clock, stick):
    devices = make(stick)
    run(devices, clock)
    stick.withdraw()
    lost = run(devices, clock, TICK_S).intent
    assert "was removed" in lost.lost
    assert lost.deflections == {}
    assert run(devices, clock, TICK_S).intent.lost is None
    stick.offer()
    stick.deflect("x", 0.8)
    devices.look()
    assert "x" not in run(devices, clock).intent.deflections
    stick.deflect("x", 0.0)
    assert run(devices, clock).intent.deflections["x"] == 0.0


def test_a_joystick_goes_before_the_pad_which_may_take_over(make, clock, stick):
    keys = pad(clock, buttons=("stop", "take_over"))
    devices = make(keys)
    run(devices, clock)
    assert devices.profile.devices[0].key == "keys:pad"
    devices.hub._sources["hid:stick"] = stick  # plugged in later
    devices.look()
    run(devices, clock)
    assert [(one.key, one.seat) for one in devices.profile.devices] == [
        ("hid:stick", OperatorRole.TRAINER),
        ("keys:pad", OperatorRole.TRAINEE),
    ]
    keys.deflect("x", 1.0)
    assert run(devices, clock).intent.deflections["x"] == 0.0
    keys.release_all()
    keys.hold("take_over")
    run(devices, clock)
    keys.hold("take_over", False)
    keys.deflect("x", 1.0)
    assert run(devices, clock).intent.device == "keys:pad"
    keys.hold("stop")
    assert Action.STOP in run(devices, clock, 0.1).intent.held
    stick.withdraw()
    devices.look()
    run(devices, clock)
    assert devices.profile.devices[0].key == "keys:pad"
    assert devices.profile.devices[0].seat is OperatorRole.TRAINER


def test_a_kept_profile_that_fits_is_used_by_itself(make, clock, stick):
    own = Profile(
        name="Mine",
        devices=(DeviceMapping(key="hid:st*", axes=(AxisMapping(control="x", drives="zn"),)),),
    )
    first = make(stick)
    first.keep(own)
    first.close()
    devices = make(stick)
    assert run(devices, clock).intent.deflections == {"zn": 0.0}
    assert devices.profile == own


def test_a_chosen_profile_stays_until_another_one_is_chosen(make, clock, stick):
    other = Profile(
        name="Elsewhere",
        devices=(DeviceMapping(key="hid:other", axes=(AxisMapping(control="x", drives="x"),)),),
    )
    devices = make(stick)
    run(devices, clock)
    devices.use(other)
    assert run(devices, clock).intent.deflections == {}
    assert any("hid:other" in problem for problem in devices.view.problems)
    devices.use(None)
    assert run(devices, clock).intent.deflections["x"] == 0.0


def test_back_to_automatic_what_was_chosen_is_used_no_more(make, clock, stick):
    mapping = DeviceMapping(key="hid:stick", axes=(AxisMapping(control="x", drives="zn"),))
    devices = make(stick)
    run(devices, clock)
    devices.use(Profile(name="Other", devices=(mapping,)))
    assert run(devices, clock).intent.deflections == {"zn": 0.0}
    devices.use(None)
    assert run(devices, clock).intent.deflections == {"x": 0.0, "y": 0.0, "z": 0.0}


def test_a_profile_with_two_owners_of_one_axis_is_refused_and_the_one_before_stays(
    make, clock, stick
):
    devices = make(stick)
    run(devices, clock)
    axes = (AxisMapping(control="x", drives="x"), AxisMapping(control="y", drives="x"))
    with pytest.raises(ProfileError, match="two owners"):
        devices.use(Profile(name="Both", devices=(DeviceMapping(key="hid:stick", axes=axes),)))
    assert devices.profile.name == "Automatic"
    assert run(devices, clock).intent.deflections["y"] == 0.0


def test_a_device_that_raises_anything_is_dropped_and_the_others_go_on(make, clock, stick):
    keys = pad(clock)
    devices = make(stick, keys)
    run(devices, clock)

    def broken():
        raise RuntimeError("a bug of a plugin")

    devices.device("hid:stick").read = broken
    intent = run(devices, clock, TICK_S).intent
    assert "a bug of a plugin" in intent.lost
    assert run(devices, clock).intent.deflections["x"] == 0.0  # the pad drives now
    assert [one.device.identity.key for one in devices.view.devices] == ["keys:pad"]
    devices.look()
    run(devices, clock)
    assert {one.device.identity.key for one in devices.view.devices} == {"hid:stick", "keys:pad"}


def test_a_calibration_is_used_and_kept(make, clock, stick):
    devices = make(stick)
    run(devices, clock)
    calibration = devices.calibrations.load(stick.identity)
    turned = calibration.with_axes({"x": calibration.axis("x").__class__(inverted=True)})
    devices.calibrate("hid:stick", turned)
    run(devices, clock)
    stick.deflect("x", 1.0)
    assert run(devices, clock, TICK_S).intent.deflections["x"] == -1.0
    assert devices.calibrations.read(stick.identity) == turned


def test_a_view_is_taken_seldom_but_at_once_after_a_change(make, clock, stick):
    devices = make(stick)
    run(devices, clock)
    before = devices.view
    run(devices, clock, TICK_S)
    run(devices, clock, TICK_S)
    assert clock() - devices.view.host_time_s <= 1.0 / 30.0
    devices.open_mapping()
    run(devices, clock, TICK_S)
    view = devices.view
    assert view is not before
    assert view.setting_up
    assert view.host_time_s == clock()
    assert [one.device.identity.key for one in view.devices] == ["hid:stick"]
    assert view.profile == devices.profile


def test_who_listens_is_told_every_step_until_it_leaves(make, clock, stick):
    devices = make(stick)
    run(devices, clock)
    heard = []
    leave = devices.listen(heard.append)
    stick.deflect("x", 0.5)
    run(devices, clock, 2 * TICK_S)
    leave()
    stick.deflect("x", 1.0)
    run(devices, clock, TICK_S)
    told = [one.readings["hid:stick"] for one in heard]
    assert [len(readings) for readings in told] == [1, 0]
    assert told[0][0].axes == (0.5, 0.0, 0.0)


def test_nobody_waits_while_a_device_is_opened(make, clock, stick):
    devices = make(stick)
    opened = stick.open

    def slowly(identity):
        other = threading.Thread(target=devices.open_mapping, daemon=True)
        other.start()
        other.join(5.0)
        assert not other.is_alive()
        return opened(identity)

    stick.open = slowly
    run(devices, clock, TICK_S)
    assert devices.view.setting_up
    assert [one.device.identity.key for one in devices.view.devices] == ["hid:stick"]


def test_a_device_that_turns_out_to_stream_is_lost_when_it_falls_silent(make, clock, stick):
    devices = make(stick)
    run(devices, clock)
    assert not devices.arbiter.views[0].device.streams
    devices.device("hid:stick").streams = True
    run(devices, clock, TICK_S)
    assert devices.arbiter.views[0].device.streams
    run(devices, clock, 0.5)
    assert "silent: a streaming device" in devices.view.devices[0].problem


def test_nothing_plugged_in_has_no_profile(make, clock):
    assert automatic_profile(()) is None
    bare = PluggedDevice(InputIdentity("hid:0", "nothing", "hid"), (), ())
    assert automatic_profile([bare]) is None
    devices = make()
    assert run(devices, clock).intent.deflections == {}
    assert devices.profile is None
