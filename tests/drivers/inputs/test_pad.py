"""Keys and pads release their controls in time, and lose no change between two threads."""

import threading

import pytest

from rotemina.drivers.contract import InputLostError, LimitError
from rotemina.drivers.inputs import InputPad


@pytest.fixture
def pad(clock):
    return InputPad("keyboard", ("x", "y"), ("stop", "mode"), clock=clock)


def test_the_first_reading_is_the_present_state(pad):
    pad.deflect("x", 1)
    (reading,) = pad.open(pad.identity).read()
    assert reading.axes == (1.0, 0.0)
    assert reading.buttons == (False, False)


def test_every_press_is_reported_even_a_short_one(pad, clock):
    device = pad.open(pad.identity)
    device.read()
    pad.hold("stop")
    clock.advance(0.001)
    pad.hold("stop", False)
    assert [reading.buttons[0] for reading in device.read()] == [True, False]


def test_release_all_is_a_single_reading(pad):
    device = pad.open(pad.identity)
    pad.deflect("x", 1.0)
    pad.deflect("y", -0.5)
    pad.hold("mode")
    device.read()
    pad.release_all()
    (reading,) = device.read()
    assert reading.axes == (0.0, 0.0)
    assert reading.buttons == (False, False)


def test_unplugging_releases_all_controls(pad):
    pad.deflect("x", 1.0)
    pad.unplug()
    pad.plug_in()
    assert pad.open(pad.identity).read()[-1].axes == (0.0, 0.0)


def test_a_device_opened_before_unplugging_stays_lost(pad):
    device = pad.open(pad.identity)
    pad.unplug()
    pad.plug_in()
    pad.deflect("x", 1.0)
    with pytest.raises(InputLostError):
        device.read()


@pytest.mark.parametrize("deflection", [1.01, -2, float("nan"), float("inf")])
def test_a_deflection_beyond_the_range_changes_nothing(pad, deflection):
    device = pad.open(pad.identity)
    device.read()
    with pytest.raises(LimitError, match=r"x at .*: must be -1 to 1"):
        pad.deflect("x", deflection)
    assert device.read() == ()


def test_unknown_controls_are_rejected(pad):
    with pytest.raises(LimitError, match="no axis 'z'; it has x, y"):
        pad.deflect("z", 0.0)
    with pytest.raises(LimitError, match="no button 'fire'; it has stop, mode"):
        pad.hold("fire")


def test_the_newest_of_too_many_unread_readings_is_kept(pad):
    device = pad.open(pad.identity)
    for number in range(5000):
        pad.deflect("x", number / 5000)
    readings = device.read()
    assert len(readings) < 5000
    assert readings[-1].axes[0] == 4999 / 5000


def test_changes_of_two_threads_are_each_reported_once_in_order(pad):
    device = pad.open(pad.identity)
    device.read()
    names = ("x", "y")

    def sweep(axis):
        for number in range(1, 201):
            pad.deflect(axis, number / 200)

    threads = [threading.Thread(target=sweep, args=(name,)) for name in names]
    for thread in threads:
        thread.start()
    readings = []
    while any(thread.is_alive() for thread in threads):
        readings += device.read()
    for thread in threads:
        thread.join()
    readings += device.read()
    assert len(readings) == 400
    for axis in range(2):
        deflections = [reading.axes[axis] for reading in readings]
        assert deflections == sorted(deflections)
        assert deflections[-1] == 1.0


@pytest.fixture
def leased_pad(clock):
    return InputPad("keyboard", ("x", "y"), ("fine",), lease_s=0.3, clock=clock)


def test_an_expired_lease_releases_the_pad(leased_pad, clock):
    device = leased_pad.open(leased_pad.identity)
    leased_pad.deflect("x", 1.0)
    leased_pad.hold("fine")
    device.read()
    clock.advance(0.29)
    (reading,) = device.read()
    assert reading.axes == (1.0, 0.0)
    clock.advance(0.02)
    (reading,) = device.read()
    assert reading.axes == (0.0, 0.0)
    assert reading.buttons == (False,)
    # The pad stays released.
    assert not leased_pad.renew()
    assert device.read() == ()


def test_a_pad_at_its_centre_can_be_renewed(leased_pad, clock):
    leased_pad.deflect("x", 0.0)
    clock.advance(10.0)
    assert leased_pad.renew()


def test_a_renewed_pad_stays_deflected(leased_pad, clock):
    device = leased_pad.open(leased_pad.identity)
    leased_pad.deflect("x", 1.0)
    device.read()
    for _ in range(10):
        clock.advance(0.2)
        assert leased_pad.renew()
        (reading,) = device.read()
        assert reading.axes == (1.0, 0.0)
        assert device.read() == ()


def test_a_released_pad_and_a_pad_without_lease_confirm_nothing(leased_pad, pad, clock):
    leased_pad.release_all()
    pad.deflect("x", 1.0)
    for source in (leased_pad, pad):
        device = source.open(source.identity)
        device.read()
        clock.advance(0.2)
        assert device.read() == ()


def test_a_late_renewal_releases_the_pad(leased_pad, clock):
    device = leased_pad.open(leased_pad.identity)
    leased_pad.deflect("x", 1.0)
    clock.advance(0.31)
    assert not leased_pad.renew()
    assert device.read()[-1].axes == (0.0, 0.0)
