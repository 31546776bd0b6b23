"""Why something cannot be done now: pure functions of the session's state."""

from dataclasses import replace

import pytest

from rotemina.app.motion.state import Connection, SessionState
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.simulator.driver import Simulator
from rotemina.plugins.connection import unavailable_reasons
from rotemina.sim.robot.file import load_robot

SIMULATOR = Simulator(load_robot("rotemina"))
PIEZO_ONLY = Simulator(load_robot("picma"))


def state(**changes):
    sound = {
        "connection": Connection.CONNECTED,
        "activity": DeviceState.IDLE,
        "position_known": True,
    }
    return SessionState(**{**sound, **changes})


CONNECTING = state(connection=Connection.CONNECTING, activity=DeviceState.CLOSED)
GONE = state(connection=Connection.DISCONNECTED, activity=DeviceState.CLOSED, locked="gone")
FAILED = state(connection=Connection.FAILED, activity=DeviceState.CLOSED, fault="x", locked="x")
MOVING = state(activity=DeviceState.MOVING)
LOST = "the connection was lost"
DISTRUSTED = state(locked=f"{LOST}: home, or confirm", doubt=LOST)


@pytest.mark.parametrize(
    ("given", "same", "why"),
    [
        (state(), False, None),
        (state(), True, "connected with these settings"),
        (GONE, True, None),
        (FAILED, True, None),
        (CONNECTING, True, "is being opened"),
        (CONNECTING, False, None),
        (MOVING, False, "still moving"),
        (replace(MOVING, silent_s=0.2), False, None),
        (replace(MOVING, age_s=3.0), False, None),  # the driver hangs
        (replace(MOVING, connection=Connection.FAILED, queued=2), False, None),
        (state(fault="hot", locked="hot"), False, None),
        (state(latched="stop and lock", locked="latched"), False, None),
        (state(age_s=3.0), True, None),
    ],
)
def test_connecting(given, same, why):
    told = unavailable_reasons.against_connecting(given, same=same)
    assert told is None if why is None else why in told


def test_disconnecting_and_reconnecting_exclude_each_other():
    for given in (state(), GONE, FAILED):
        told = (
            unavailable_reasons.against_disconnecting(given),
            unavailable_reasons.against_reconnecting(given),
        )
        assert told.count(None) == 1
    assert unavailable_reasons.against_disconnecting(CONNECTING) is None
    assert "being opened" in unavailable_reasons.against_reconnecting(CONNECTING)


@pytest.mark.parametrize(
    ("given", "why"),
    [
        (state(), None),
        (state(position_known=False, locked="home first"), None),
        (MOVING, "still moving"),
        (state(queued=1), "still moving"),
        (state(fault="hot", locked="hot"), "clear it first"),
        (state(latched="emergency stop", locked="latched"), "release it first"),
        (state(silent_s=0.2), "does not answer"),
        (GONE, "not connected"),
    ],
)
def test_homing(given, why):
    told = unavailable_reasons.against_homing(given, SIMULATOR)
    assert told is None if why is None else why in told
    assert "no limit switches" in unavailable_reasons.against_homing(given, PIEZO_ONLY)


def test_only_a_doubtful_position_is_confirmed():
    assert unavailable_reasons.against_confirming(DISTRUSTED) is None
    assert "position is certain" in unavailable_reasons.against_confirming(state())
    assert "position is certain" in unavailable_reasons.against_confirming(
        state(locked="differ", differences=("a",), doubt=LOST)
    )
    assert "home first" in unavailable_reasons.against_confirming(
        state(position_known=False, locked="home")
    )


def test_going_back():
    assert unavailable_reasons.against_going_back(state(), undoable=True) is None
    assert "no previous position" in unavailable_reasons.against_going_back(state(), undoable=False)
    assert "still moving" in unavailable_reasons.against_going_back(MOVING, undoable=True)
    assert unavailable_reasons.against_going_back(DISTRUSTED, undoable=True) == DISTRUSTED.locked


def test_clearing_and_writing():
    assert unavailable_reasons.against_clearing(state(fault="hot")) is None
    assert "no fault" in unavailable_reasons.against_clearing(state())
    assert "connect" in unavailable_reasons.against_clearing(FAILED)
    assert "stores no parameters" in unavailable_reasons.against_writing(state(), SIMULATOR)


def test_floor():
    assert "no tip" in unavailable_reasons.against_teaching(state(), None)
    assert "no tip" in unavailable_reasons.against_removing(None)
