"""Reasons why an action is unavailable: pure functions of the session state."""

from dataclasses import replace

import pytest

from rotemina.app.motion.state import ConnectionState, SessionState
from rotemina.drivers.contract import DeviceState
from rotemina.drivers.simulator import Simulator
from rotemina.plugins.connection import unavailable_reasons
from rotemina.sim.robot_files import load_robot

SIMULATOR = Simulator(load_robot("rotemina"))
PIEZO_ONLY = Simulator(load_robot("picma"))


def make_state(**changes):
    connected_state = {
        "connection": ConnectionState.CONNECTED,
        "activity": DeviceState.IDLE,
        "position_known": True,
    }
    return SessionState(**{**connected_state, **changes})


CONNECTING = make_state(connection=ConnectionState.CONNECTING, activity=DeviceState.CLOSED)
DISCONNECTED = make_state(
    connection=ConnectionState.DISCONNECTED, activity=DeviceState.CLOSED, lock_reason="gone"
)
FAILED = make_state(
    connection=ConnectionState.FAILED, activity=DeviceState.CLOSED, fault="x", lock_reason="x"
)
MOVING = make_state(activity=DeviceState.MOVING)
LOST = "the connection was lost"
DISTRUSTED = make_state(lock_reason=f"{LOST}: home, or confirm", doubt=LOST)


@pytest.mark.parametrize(
    ("state", "is_in_use", "reason"),
    [
        (make_state(), False, None),
        (make_state(), True, "connected with these settings"),
        (DISCONNECTED, True, None),
        (FAILED, True, None),
        (CONNECTING, True, "is being opened"),
        (CONNECTING, False, None),
        (MOVING, False, "still moving"),
        (replace(MOVING, silent_s=0.2), False, None),
        (replace(MOVING, age_s=3.0), False, None),  # the driver hangs
        (replace(MOVING, connection=ConnectionState.FAILED, queued=2), False, None),
        (make_state(fault="hot", lock_reason="hot"), False, None),
        (make_state(latch_reason="stop and lock", lock_reason="latched"), False, None),
        (make_state(age_s=3.0), True, None),
    ],
)
def test_connect_objection(state, is_in_use, reason):
    objection = unavailable_reasons.find_connect_objection(state, is_in_use=is_in_use)
    assert objection is None if reason is None else reason in objection


def test_disconnecting_and_reconnecting_exclude_each_other():
    for state in (make_state(), DISCONNECTED, FAILED):
        objections = (
            unavailable_reasons.find_disconnect_objection(state),
            unavailable_reasons.find_reconnect_objection(state),
        )
        assert objections.count(None) == 1
    assert unavailable_reasons.find_disconnect_objection(CONNECTING) is None
    assert "being opened" in unavailable_reasons.find_reconnect_objection(CONNECTING)


@pytest.mark.parametrize(
    ("state", "reason"),
    [
        (make_state(), None),
        (make_state(position_known=False, lock_reason="home first"), None),
        (MOVING, "still moving"),
        (make_state(queued=1), "still moving"),
        (make_state(fault="hot", lock_reason="hot"), "clear it first"),
        (make_state(latch_reason="emergency stop", lock_reason="latched"), "release it first"),
        (make_state(silent_s=0.2), "does not answer"),
        (DISCONNECTED, "not connected"),
    ],
)
def test_homing_objection(state, reason):
    objection = unavailable_reasons.find_homing_objection(state, SIMULATOR)
    assert objection is None if reason is None else reason in objection
    assert "no limit switches" in unavailable_reasons.find_homing_objection(state, PIEZO_ONLY)


def test_only_a_doubtful_position_is_confirmed():
    assert unavailable_reasons.find_confirm_objection(DISTRUSTED) is None
    assert "position is certain" in unavailable_reasons.find_confirm_objection(make_state())
    assert "home first" in unavailable_reasons.find_confirm_objection(
        make_state(position_known=False, lock_reason="home")
    )


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"fault": "hot"}, "there is a fault; clear it first"),
        ({"silent_s": 0.2}, "the device does not answer"),
        ({"differences": ("a",)}, "the parameters differ from the robot file"),
    ],
)
def test_another_problem_is_solved_before_the_position_is_confirmed(changes, reason):
    state = make_state(lock_reason="another reason", doubt=LOST, **changes)
    assert reason in unavailable_reasons.find_confirm_objection(state)
    certain_state = replace(state, doubt=None)
    assert "position is certain" in unavailable_reasons.find_confirm_objection(certain_state)


def test_undo_objection():
    assert unavailable_reasons.find_undo_objection(make_state(), undoable=True) is None
    assert "no previous position" in unavailable_reasons.find_undo_objection(
        make_state(), undoable=False
    )
    assert "still moving" in unavailable_reasons.find_undo_objection(MOVING, undoable=True)
    assert (
        unavailable_reasons.find_undo_objection(DISTRUSTED, undoable=True) == DISTRUSTED.lock_reason
    )


def test_clear_and_write_objections():
    assert unavailable_reasons.find_clear_objection(make_state(fault="hot")) is None
    assert "no fault" in unavailable_reasons.find_clear_objection(make_state())
    assert "connect" in unavailable_reasons.find_clear_objection(FAILED)
    assert "stores no parameters" in unavailable_reasons.find_write_objection(
        make_state(), SIMULATOR
    )
