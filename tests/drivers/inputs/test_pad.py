"""Keys and pads: what is held is released when told, and nothing is lost between two threads."""

import threading

import pytest

from rotemina.drivers.errors import LimitError
from rotemina.drivers.inputs.device import InputLostError
from rotemina.drivers.inputs.pad import Pad


@pytest.fixture
def pad(clock):
    return Pad("keyboard", ("x", "y"), ("stop", "mode"), clock=clock)


def test_it_first_tells_how_it_stands(pad):
    pad.deflect("x", 1)
    (reading,) = pad.open(pad.identity).read()
    assert reading.axes == (1.0, 0.0)
    assert reading.buttons == (False, False)


def test_each_press_is_told_however_short(pad, clock):
    device = pad.open(pad.identity)
    device.read()
    pad.hold("stop")
    clock.advance(0.001)
    pad.hold("stop", False)
    assert [reading.buttons[0] for reading in device.read()] == [True, False]


def test_all_is_released_at_once(pad):
    device = pad.open(pad.identity)
    pad.deflect("x", 1.0)
    pad.deflect("y", -0.5)
    pad.hold("mode")
    device.read()
    pad.release_all()
    (reading,) = device.read()
    assert reading.axes == (0.0, 0.0)
    assert reading.buttons == (False, False)


def test_taken_away_it_is_released_too(pad):
    pad.deflect("x", 1.0)
    pad.withdraw()
    pad.offer()
    assert pad.open(pad.identity).read()[-1].axes == (0.0, 0.0)


def test_taken_away_and_offered_again_the_old_one_stays_lost(pad):
    device = pad.open(pad.identity)
    pad.withdraw()
    pad.offer()
    pad.deflect("x", 1.0)
    with pytest.raises(InputLostError):
        device.read()


@pytest.mark.parametrize("deflection", [1.01, -2, float("nan"), float("inf")])
def test_beyond_the_range_nothing_changes(pad, deflection):
    device = pad.open(pad.identity)
    device.read()
    with pytest.raises(LimitError, match=r"x at .*: must be -1 to 1"):
        pad.deflect("x", deflection)
    assert device.read() == ()


def test_what_it_does_not_have_is_named(pad):
    with pytest.raises(LimitError, match="no axis 'z'; it has x, y"):
        pad.deflect("z", 0.0)
    with pytest.raises(LimitError, match="no button 'fire'; it has stop, mode"):
        pad.hold("fire")


def test_left_unread_the_newest_is_kept(pad):
    device = pad.open(pad.identity)
    for number in range(5000):
        pad.deflect("x", number / 5000)
    readings = device.read()
    assert len(readings) < 5000
    assert readings[-1].axes[0] == 4999 / 5000


def test_set_by_two_threads_each_change_is_told_once_in_order(pad):
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
        told = [reading.axes[axis] for reading in readings]
        assert told == sorted(told)
        assert told[-1] == 1.0


@pytest.fixture
def leased(clock):
    return Pad("keyboard", ("x", "y"), ("fine",), lease_s=0.3, clock=clock)


def test_held_by_somebody_who_says_nothing_any_more_it_is_released(leased, clock):
    device = leased.open(leased.identity)
    leased.deflect("x", 1.0)
    leased.hold("fine")
    device.read()
    clock.advance(0.29)
    (reading,) = device.read()
    assert reading.axes == (1.0, 0.0)
    clock.advance(0.02)
    (reading,) = device.read()
    assert reading.axes == (0.0, 0.0)
    assert reading.buttons == (False,)
    assert not leased.renew()  # and stays so
    assert device.read() == ()


def test_held_at_its_centre_it_is_held_all_the_same(leased, clock):
    leased.deflect("x", 0.0)
    clock.advance(10.0)
    assert leased.renew()


def test_renewed_it_is_held_on(leased, clock):
    device = leased.open(leased.identity)
    leased.deflect("x", 1.0)
    device.read()
    for _ in range(10):
        clock.advance(0.2)
        assert leased.renew()
        (reading,) = device.read()
        assert reading.axes == (1.0, 0.0)
        assert device.read() == ()


def test_released_or_without_a_lease_it_confirms_nothing(leased, pad, clock):
    leased.release_all()
    pad.deflect("x", 1.0)
    for one in (leased, pad):
        device = one.open(one.identity)
        device.read()
        clock.advance(0.2)
        assert device.read() == ()


def test_too_late_to_renew_it_is_released(leased, clock):
    device = leased.open(leased.identity)
    leased.deflect("x", 1.0)
    clock.advance(0.31)
    assert not leased.renew()
    assert device.read()[-1].axes == (0.0, 0.0)
