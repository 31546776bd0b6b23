"""Limits of a session: bounds of the tip, owners, leases, latches and undo."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.state import SessionPhase
from rotemina.drivers.contract import DeviceState, VirtualClock
from rotemina.drivers.simulator import Simulator
from rotemina.sim.errors import InputError, OutOfLimitsError
from rotemina.sim.kinematics import MAX_SLOW_ZONE_SPEED_M_PER_S, SLOW_ZONE_HEIGHT_M
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import KeepOut
from rotemina.sim.robot_files import load_robot

FLOOR = -2e-3
ROBOT = replace(load_robot("rotemina"), keep_out=KeepOut(floor=FLOOR, radius=0.02))


@pytest.fixture
def session_with_floor(make_harness):
    return make_harness(ROBOT, driver=Simulator)


@pytest.fixture
def session_without_floor(make_harness):
    harness = make_harness(driver=Simulator)
    harness.step()
    return harness


def read_heights(harness):
    window = harness.session.history.tail()
    return window.device_time_s, harness.session.bounds.keep_out.tip_at(window.command)[:, 2]


def test_a_move_below_the_floor_is_refused_with_the_reason(session_with_floor):
    session_with_floor.step()
    with pytest.raises(OutOfLimitsError, match=r"its floor is -2 mm"):
        session_with_floor.session.go_to({"z": 0.03})
    with pytest.raises(OutOfLimitsError, match="from the middle"):
        session_with_floor.session.go_to({"x": 0.05})
    with pytest.raises(OutOfLimitsError, match="its floor"):
        session_with_floor.session.jog("z", -3e-3)
    assert session_with_floor.step().activity is DeviceState.IDLE


def test_a_move_into_the_slow_zone_slows_down_and_arrives(session_with_floor):
    session_with_floor.step()
    session_with_floor.session.go_to({"z": 0.0383})
    session_with_floor.step_until_idle()
    time_s, height = read_heights(session_with_floor)
    assert session_with_floor.session.snapshot().command["z"] == 0.0383
    descent_speed = -np.gradient(height, time_s)
    assert (
        descent_speed[height < FLOOR + 0.9 * SLOW_ZONE_HEIGHT_M]
        <= 1.01 * MAX_SLOW_ZONE_SPEED_M_PER_S
    ).all()
    assert descent_speed.max() > 4 * MAX_SLOW_ZONE_SPEED_M_PER_S
    assert height.min() >= FLOOR


def test_a_stop_between_the_legs_of_a_move_ends_it(session_with_floor):
    session_with_floor.step()
    session_with_floor.session.go_to({"z": 0.0383})
    session_with_floor.step(0.1)
    session_with_floor.session.stop()
    state = session_with_floor.step_until_idle()
    rest_z = state.command["z"]
    assert session_with_floor.step(1.0, 3).command["z"] == rest_z


def test_driving_down_ends_above_the_floor(session_with_floor):
    session_with_floor.step()
    refused = False
    for _ in range(2000):
        try:
            session_with_floor.session.move_velocity({"z": -2e-3, "x": 1e-3}, 0.1)
        except OutOfLimitsError:
            refused = True
            break
        session_with_floor.step(0.02)
    assert refused
    session_with_floor.step_until_idle()
    time_s, height = read_heights(session_with_floor)
    assert FLOOR <= height.min() <= FLOOR + 2e-4
    descent_speed = -np.gradient(height, time_s)
    assert (
        descent_speed[height < FLOOR + 0.9 * SLOW_ZONE_HEIGHT_M]
        <= 1.01 * MAX_SLOW_ZONE_SPEED_M_PER_S
    ).all()


def test_a_trajectory_below_the_floor_is_refused_and_one_above_plays(session_with_floor):
    session_with_floor.step()
    time_s = np.linspace(0, 20.0, 20_001)

    def make_dive(depth):
        command = 0.04 - depth * 0.5 * (1 - np.cos(2 * np.pi * time_s / 20.0))
        return Record.from_signals(time_s, {("z", Tap.CMD): command}, {"z": "m"})

    with pytest.raises(OutOfLimitsError, match="its floor"):
        session_with_floor.session.play(make_dive(3e-3))
    session_with_floor.session.play(make_dive(1e-3))
    assert session_with_floor.step_until(DeviceState.PLAYING).owners["x"] == "playback"
    with pytest.raises(RequestRefusedError):
        session_with_floor.session.go_to({"x": 0.03})


def test_the_floor_is_taught_at_the_tip(session_with_floor):
    session_with_floor.step()
    floor = session_with_floor.session.bounds.teach_floor(1e-4)
    tip = session_with_floor.session.snapshot().tip
    assert floor == pytest.approx(tip[2] - 1e-4, abs=1e-12)
    with pytest.raises(OutOfLimitsError, match="its floor"):
        session_with_floor.session.jog("z", -2e-4)
    session_with_floor.session.jog("z", 2e-4)
    session_with_floor.step_until_idle()
    session_with_floor.session.bounds.clear_floor()
    session_with_floor.session.jog("z", -1e-2)


def test_an_expired_lease_halts_the_axis_without_a_fault(session_without_floor):
    session_without_floor.session.move_velocity({"x": 5e-3}, 0.1)
    session_without_floor.step(0.02)
    assert session_without_floor.session.snapshot().phase is SessionPhase.MOVING
    state = session_without_floor.step_until_idle()
    assert state.fault is None
    distance = state.command["x"] - 0.0275
    assert 0.1 * 5e-3 * 0.7 < distance <= 5e-3 * 0.1 + 1e-6


def test_a_speed_that_waited_too_long_is_not_executed(session_without_floor):
    session_without_floor.session.move_velocity({"x": 5e-3}, 0.1)
    session_without_floor.clock.advance(0.2)
    assert session_without_floor.step().activity is DeviceState.IDLE
    assert session_without_floor.session.snapshot().command["x"] == 0.0275


def test_renewals_of_a_speed_replace_each_other_in_the_queue(session_without_floor):
    for speed in np.linspace(1e-3, 5e-3, 50):
        session_without_floor.session.move_velocity({"x": float(speed)}, 0.5)
    assert session_without_floor.session.snapshot().queued == 1


def test_an_axis_has_one_owner_until_it_rests(session_without_floor):
    session_without_floor.session.go_to({"x": 0.03}, owner="joystick")
    session_without_floor.step()
    assert session_without_floor.session.snapshot().owners == {"x": "joystick"}
    with pytest.raises(RequestRefusedError, match="joystick controls axis x"):
        session_without_floor.session.jog("x", 1e-3)
    session_without_floor.session.jog("y", 1e-3)
    session_without_floor.session.reservations.take_over(["x"], "operator")
    session_without_floor.session.go_to({"x": 0.029})
    session_without_floor.step_until_idle()
    assert session_without_floor.step().owners == {}
    session_without_floor.session.go_to({"x": 0.03}, owner="script")


def test_an_emergency_stop_stays_until_it_is_released(session_without_floor):
    session_without_floor.session.go_to({"x": 0.05})
    session_without_floor.step(0.2)
    session_without_floor.session.emergency_stop()
    state = session_without_floor.step_until_idle()
    assert "stop and lock is active" in state.lock_reason
    for request in (
        lambda: session_without_floor.session.jog("x", 1e-3),
        lambda: session_without_floor.session.move_velocity({"x": 1e-3}),
        session_without_floor.session.home,
        session_without_floor.session.undo,
    ):
        with pytest.raises(RequestRefusedError, match="release it first"):
            request()
    assert session_without_floor.step(1.0).command == state.command
    session_without_floor.session.release()
    session_without_floor.session.jog("x", 1e-3)


def test_a_barred_session_refuses_motion_with_the_reason(session_without_floor):
    session_without_floor.session.go_to({"x": 0.05})
    session_without_floor.step(0.2)
    session_without_floor.session.bar_motion("a replay is shown")
    reached = session_without_floor.step_until_idle()
    assert reached.command["x"] == pytest.approx(0.05)  # the present move continues
    assert reached.lock_reason == "a replay is shown"
    for request in (
        lambda: session_without_floor.session.jog("x", 1e-3),
        lambda: session_without_floor.session.move_velocity({"x": 1e-3}),
        session_without_floor.session.home,
        session_without_floor.session.undo,
    ):
        with pytest.raises(RequestRefusedError, match="a replay is shown"):
            request()
    session_without_floor.session.bar_motion(None)
    session_without_floor.session.undo()


def test_the_phase_follows_the_motion(session_without_floor):
    assert session_without_floor.session.snapshot().phase is SessionPhase.READY
    session_without_floor.session.go_to({"x": 0.05})
    assert session_without_floor.step(0.1, 2).phase is SessionPhase.MOVING
    session_without_floor.session.stop()
    assert session_without_floor.step(0.02).phase is SessionPhase.STOPPING
    session_without_floor.step_until_idle()
    assert session_without_floor.session.snapshot().phase is SessionPhase.READY
    session_without_floor.session.close()
    assert session_without_floor.session.snapshot().phase is SessionPhase.DISCONNECTED


def test_an_unknown_position_locks_motion_until_homed(make_harness):
    harness = make_harness(driver=Simulator, settings={"start_homed": False})
    state = harness.step()
    assert state.phase is SessionPhase.POSITION_UNKNOWN
    with pytest.raises(RequestRefusedError, match="home first"):
        harness.session.jog("x", 1e-3)
    harness.session.home()
    assert harness.step(0.1).activity is DeviceState.HOMING
    with pytest.raises(RequestRefusedError, match="wait before homing"):
        harness.session.home()
    with pytest.raises(RequestRefusedError, match="home first"):
        harness.session.jog("x", 1e-3)
    state = harness.step_until_idle()
    assert state.phase is SessionPhase.READY
    harness.session.jog("x", 1e-3)


def test_undo_returns_on_a_safe_path(session_without_floor):
    begin = session_without_floor.session.snapshot().command
    session_without_floor.session.go_to({"x": 0.03, "z": 0.038})
    reached = session_without_floor.step_until_idle().command
    session_without_floor.session.undo()
    session_without_floor.step_until_idle()
    assert session_without_floor.session.snapshot().command == begin
    window = session_without_floor.session.history.tail()
    x, z = window.command[:, 0], window.command[:, 2]
    is_crossing = (x < reached["x"] - 1e-4) & (x > begin["x"] + 1e-4)
    is_returning = is_crossing & (np.arange(len(x)) > len(x) // 2)
    assert z[is_returning].min() >= max(begin["z"], reached["z"]) + 0.9e-3
    with pytest.raises(RequestRefusedError, match="no previous position"):
        session_without_floor.session.undo()


def test_can_undo_is_known_and_ends_with_the_device(session_without_floor):
    assert not session_without_floor.session.can_undo
    session_without_floor.session.jog("x", 1e-3)
    session_without_floor.step_until_idle()
    assert session_without_floor.session.can_undo
    session_without_floor.session.undo()
    session_without_floor.step_until_idle()
    assert not session_without_floor.session.can_undo
    session_without_floor.session.jog("x", 1e-3)
    session_without_floor.step_until_idle()
    session_without_floor.session.use_driver(
        Simulator(session_without_floor.driver.robot, clock=session_without_floor.clock)
    )
    session_without_floor.step(times=3)
    assert not session_without_floor.session.can_undo
    with pytest.raises(RequestRefusedError, match="no previous position"):
        session_without_floor.session.undo()


REQUESTS = st.one_of(
    st.tuples(
        st.just("go"),
        st.dictionaries(st.sampled_from(["x", "y", "z", "zn"]), st.floats(-0.01, 0.09)),
    ),
    st.tuples(
        st.just("drive"),
        st.dictionaries(st.sampled_from(["x", "y", "z", "thx"]), st.floats(-0.01, 0.01)),
    ),
    st.tuples(st.just("stop"), st.none()),
    st.tuples(st.just("undo"), st.none()),
    st.tuples(st.just("wait"), st.floats(0.0, 0.5)),
)


@settings(
    max_examples=40,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(st.lists(REQUESTS, max_size=12))
def test_no_sequence_of_requests_leaves_the_bounds(harness_type, requests):
    clock = VirtualClock(1.0)
    harness = harness_type(Simulator(ROBOT, clock=clock), clock).connect()
    harness.step()
    for kind, value in requests:
        try:
            if kind == "go":
                harness.session.go_to(value)
            elif kind == "drive":
                harness.session.move_velocity(value, 0.2)
            elif kind == "undo":
                harness.session.undo()
            elif kind == "stop":
                harness.session.stop()
        except InputError:
            pass
        harness.step(value if kind == "wait" else 0.03)
    harness.step(0.1, 30)
    window = harness.session.history.tail()
    for column, axis in enumerate(ROBOT.axes.values()):
        assert window.command[:, column].min() >= axis.range[0]
        assert window.command[:, column].max() <= axis.range[1]
    tip = harness.session.bounds.keep_out.tip_at(window.command)
    middle = harness.session.bounds.keep_out.tip_at(
        np.array([sum(axis.range) / 2 for axis in ROBOT.axes.values()])
    )
    assert tip[:, 2].min() >= FLOOR - 1e-9
    assert np.hypot(*(tip - middle)[:, :2].T).max() <= 0.02 + 1e-9


def test_another_driver_replaces_the_first(session_without_floor, clock):
    first = session_without_floor.driver
    session_without_floor.session.go_to({"x": 0.05})
    session_without_floor.step(0.1, 2)
    second = Simulator(load_robot("rotemina"), {"start_fraction": 0.25}, clock=clock)
    session_without_floor.session.use_driver(second)
    state = session_without_floor.step(0.02, 2)
    assert first.status().state is DeviceState.CLOSED
    assert state.command["x"] == pytest.approx(0.055 / 4)
    session_without_floor.session.jog("x", 1e-3)
    assert session_without_floor.step_until_idle().command["x"] == pytest.approx(0.055 / 4 + 1e-3)
    with pytest.raises(RequestRefusedError, match="start the program with that robot"):
        session_without_floor.session.use_driver(Simulator(load_robot("picma"), clock=clock))


def test_a_session_disconnects_and_reconnects(session_without_floor):
    session_without_floor.session.disconnect()
    state = session_without_floor.step(0.02)
    assert state.phase is SessionPhase.DISCONNECTED
    assert session_without_floor.driver.status().state is DeviceState.CLOSED
    session_without_floor.session.reconnect()
    assert session_without_floor.step(0.02, 2).phase is SessionPhase.READY


def test_a_refused_request_keeps_the_owners(make_harness):
    harness = make_harness(driver=Simulator, queue_size=1)
    harness.step()
    harness.session.go_to({"x": 0.03}, owner="script")
    with pytest.raises(RequestRefusedError, match="already waiting"):
        harness.session.go_to({"y": 0.03}, owner="joystick")
    assert harness.session.snapshot().owners == {"x": "script"}
