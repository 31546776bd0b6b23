"""The state that is taken from a device's status, without a session."""

import pytest

from rotemina.app.motion.device.device_report import with_status
from rotemina.app.motion.state import SessionState
from rotemina.drivers.contract import DeviceState, DeviceStatus
from rotemina.drivers.simulator import Simulator
from rotemina.sim.robot_files import load_robot


@pytest.fixture(scope="module")
def driver():
    return Simulator(load_robot("rotemina"))


@pytest.mark.parametrize(
    ("between_segments", "activity"), [(True, DeviceState.MOVING), (False, DeviceState.IDLE)]
)
def test_a_device_between_two_segments_still_moves(driver, between_segments, activity):
    status = DeviceStatus(DeviceState.IDLE)
    state = with_status(SessionState(), driver, status, between_segments=between_segments)
    assert state.activity is activity


def test_a_fault_between_two_segments_is_a_fault(driver):
    status = DeviceStatus(DeviceState.FAULT, fault="axis x: lost steps")
    state = with_status(SessionState(), driver, status, between_segments=True)
    assert (state.activity, state.fault) == (DeviceState.FAULT, "axis x: lost steps")
