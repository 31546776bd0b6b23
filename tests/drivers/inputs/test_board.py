"""The controller's joystick is lost with its driver, and sends no requests to the device."""

import pytest

from rotemina.drivers.contract import DeviceState, DeviceStatus, InputLostError
from rotemina.drivers.inputs import BoardJoystickSource
from rotemina.drivers.inputs.device import KEEPALIVE_PERIOD_S
from rotemina.drivers.simulator import Simulator
from rotemina.sim.robot_files import load_robot


class SimulatorWithStatus(Simulator):
    """A simulator whose status a test can set."""

    given_status = None

    def _status(self):
        return self.given_status or super()._status()


class DriverWithoutJoystick:
    pass


@pytest.fixture
def driver(clock):
    driver = SimulatorWithStatus(load_robot("rotemina"), clock=clock)
    driver.open()
    driver.set_analog_inputs([0.0, 0.5, 1.0], [True])
    yield driver
    driver.close()


@pytest.fixture
def driver_holder(driver):
    """Return a list that contains only the driver in use."""
    return [driver]


@pytest.fixture
def source(driver_holder, clock):
    return BoardJoystickSource(lambda: driver_holder[0], clock=clock)


@pytest.fixture
def joystick(source):
    return source.open(source.devices()[0])


def test_readings_of_0_to_1_become_deflections(joystick, clock):
    (reading,) = joystick.read()
    assert reading.axes == (-1.0, 0.0, 1.0)
    assert reading.buttons == (True,)
    assert reading.host_time_s == clock()
    assert joystick.axes == ("Potentiometer 1", "Potentiometer 2", "Potentiometer 3")


def test_an_unchanged_state_is_read_again_only_as_a_confirmation(joystick, driver, clock):
    (first,) = joystick.read()
    driver.set_analog_inputs([0.0, 0.5, 1.0], [True])
    assert joystick.read() == ()
    clock.advance(1.1 * KEEPALIVE_PERIOD_S)
    (confirmation,) = joystick.read()
    assert (confirmation.axes, confirmation.buttons) == (first.axes, first.buttons)
    assert confirmation.host_time_s == clock()
    # A stream that confirms its state regularly has failed when a confirmation is missing.
    assert joystick.streams


@pytest.mark.parametrize(
    ("status", "reason"),
    [
        (DeviceStatus(DeviceState.FAULT, fault="limit switch"), "clear the fault"),
        (DeviceStatus(DeviceState.IDLE, silent_s=0.2), "do not respond"),
    ],
)
def test_a_joystick_is_lost_while_its_driver_has_a_problem(
    source, joystick, driver, status, reason
):
    driver.given_status = status
    with pytest.raises(InputLostError, match=reason):
        joystick.read()
    assert source.devices() == ()
    with pytest.raises(InputLostError, match=reason):
        source.open(joystick.identity)
    driver.given_status = None
    assert source.devices() == (joystick.identity,)


def test_a_change_of_driver_loses_the_joystick(source, joystick, driver_holder, clock):
    other_driver = Simulator(load_robot("rotemina"), clock=clock)
    driver_holder[0] = other_driver
    with pytest.raises(InputLostError, match="another driver"):
        joystick.read()
    # The other driver has no readings yet.
    assert source.devices() == ()
    other_driver.open()
    other_driver.set_analog_inputs([0.5], [])
    assert len(source.open(source.devices()[0]).axes) == 1
    other_driver.close()


@pytest.mark.parametrize("driver_in_use", [None, DriverWithoutJoystick()])
def test_a_driver_without_a_joystick_offers_no_device(
    source, joystick, driver_holder, driver_in_use
):
    driver_holder[0] = driver_in_use
    assert source.devices() == ()
    assert source.problem is None
    with pytest.raises(InputLostError):
        source.open(joystick.identity)


def test_a_joystick_whose_number_of_controls_changes_is_lost(joystick, driver):
    driver.set_analog_inputs([0.5], [True])
    with pytest.raises(InputLostError, match="now has 1 axes and 1 buttons instead of 3 and 1"):
        joystick.read()


def test_a_driver_that_is_closed_during_a_reading_loses_the_joystick(joystick, driver, monkeypatch):
    def raise_attribute_error():
        raise AttributeError("'NoneType' object has no attribute 'boards'")

    monkeypatch.setattr(driver, "analog_inputs", raise_attribute_error)
    with pytest.raises(InputLostError, match="cannot be read"):
        joystick.read()
