"""The controller's joystick is lost with its driver, and asks nothing of the device."""

import pytest

from rotemina.drivers.inputs.board import BoardInputs
from rotemina.drivers.inputs.device import CONFIRM_S, InputLostError
from rotemina.drivers.samples import DeviceState, DeviceStatus
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.robot.file import load_robot


class Troubled(Simulator):
    """A simulator whose status a test gives."""

    told = None

    def _status(self):
        return self.told or super()._status()


class Plain:
    """A driver without a joystick."""


@pytest.fixture
def driver(clock):
    driver = Troubled(load_robot("rotemina"), clock=clock)
    driver.open()
    driver.set_analog_inputs([0.0, 0.5, 1.0], [True])
    yield driver
    driver.close()


@pytest.fixture
def in_use(driver):
    return [driver]


@pytest.fixture
def source(in_use, clock):
    return BoardInputs(lambda: in_use[0], clock=clock)


@pytest.fixture
def joystick(source):
    return source.open(source.devices()[0])


def test_readings_of_0_to_1_become_deflections(joystick, clock):
    (reading,) = joystick.read()
    assert reading.axes == (-1.0, 0.0, 1.0)
    assert reading.buttons == (True,)
    assert reading.host_time_s == clock()
    assert joystick.axes == ("Potentiometer 1", "Potentiometer 2", "Potentiometer 3")


def test_nothing_new_is_no_reading_until_it_is_confirmed(joystick, driver, clock):
    (first,) = joystick.read()
    driver.set_analog_inputs([0.0, 0.5, 1.0], [True])
    assert joystick.read() == ()
    clock.advance(1.1 * CONFIRM_S)
    (again,) = joystick.read()
    assert (again.axes, again.buttons) == (first.axes, first.buttons)
    assert again.host_time_s == clock()
    assert joystick.streams  # so that no confirmation is a failure


@pytest.mark.parametrize(
    ("status", "reason"),
    [
        (DeviceStatus(DeviceState.FAULT, fault="limit switch"), "clear the fault"),
        (DeviceStatus(DeviceState.IDLE, silent_s=0.2), "have been silent"),
    ],
)
def test_a_driver_in_trouble_is_not_trusted(source, joystick, driver, status, reason):
    driver.told = status
    with pytest.raises(InputLostError, match=reason):
        joystick.read()
    assert source.devices() == ()
    with pytest.raises(InputLostError, match=reason):
        source.open(joystick.identity)
    driver.told = None
    assert source.devices() == (joystick.identity,)


def test_another_driver_is_another_joystick(source, joystick, in_use, clock):
    other = Simulator(load_robot("rotemina"), clock=clock)
    in_use[0] = other
    with pytest.raises(InputLostError, match="another driver"):
        joystick.read()
    assert source.devices() == ()  # it has told nothing yet
    other.open()
    other.set_analog_inputs([0.5], [])
    assert len(source.open(source.devices()[0]).axes) == 1
    other.close()


@pytest.mark.parametrize("driver_in_use", [None, Plain()])
def test_a_driver_without_a_joystick_has_none(source, joystick, in_use, driver_in_use):
    in_use[0] = driver_in_use
    assert source.devices() == ()
    assert source.problem is None
    with pytest.raises(InputLostError):
        source.open(joystick.identity)


def test_a_joystick_that_changes_its_size_is_lost(joystick, driver):
    driver.set_analog_inputs([0.5], [True])
    with pytest.raises(InputLostError, match="now has 1 axes and 1 buttons instead of 3 and 1"):
        joystick.read()


def test_a_driver_that_is_closed_in_the_middle_of_the_question_is_lost(
    joystick, driver, monkeypatch
):
    def closing():
        raise AttributeError("'NoneType' object has no attribute 'boards'")

    monkeypatch.setattr(driver, "analog_inputs", closing)
    with pytest.raises(InputLostError, match="cannot be read"):
        joystick.read()
