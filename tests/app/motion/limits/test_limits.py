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
def machine(make_harness):
    """A session at rest above a floor."""
    harness = make_harness(ROBOT, driver=Simulator)
    harness.step()
    return harness


@pytest.fixture
def free_machine(make_harness):
    """A session at rest without a floor."""
    harness = make_harness(driver=Simulator)
    harness.step()
    return harness


def check_descent(harness):
    """Check that the tip went down slowly near the floor; return height and speed (n,), SI."""
    window = harness.session.history.tail()
    height = harness.session.bounds.keep_out.tip_at(window.command)[:, 2]
    descent_speed = -np.gradient(height, window.device_time_s)
    is_in_slow_zone = height < FLOOR + 0.9 * SLOW_ZONE_HEIGHT_M
    assert (descent_speed[is_in_slow_zone] <= 1.01 * MAX_SLOW_ZONE_SPEED_M_PER_S).all()
    assert height.min() >= FLOOR
    return height, descent_speed


def test_a_move_below_the_floor_is_refused_with_the_reason(machine):
    for request, message in (
        (lambda: machine.session.go_to({"z": 0.03}), r"its floor is -2 mm"),
        (lambda: machine.session.go_to({"x": 0.05}), "from the middle"),
        (lambda: machine.session.jog("z", -3e-3), "its floor"),
    ):
        with pytest.raises(OutOfLimitsError, match=message):
            request()
    assert machine.step().activity is DeviceState.IDLE


def test_a_move_into_the_slow_zone_slows_down_and_arrives(machine):
    machine.session.go_to({"z": 0.0383})
    machine.step_until_idle()
    assert machine.session.snapshot().command["z"] == 0.0383
    _, descent_speed = check_descent(machine)
    assert descent_speed.max() > 4 * MAX_SLOW_ZONE_SPEED_M_PER_S


def test_driving_down_ends_above_the_floor(machine):
    def drive_down():
        for _ in range(2000):
            machine.session.move_velocity({"z": -2e-3, "x": 1e-3}, 0.1)
            machine.step(0.02)

    with pytest.raises(OutOfLimitsError):
        drive_down()
    machine.step_until_idle()
    height, _ = check_descent(machine)
    assert height.min() <= FLOOR + 2e-4


def test_a_trajectory_below_the_floor_is_refused_and_one_above_plays(machine):
    time_s = np.linspace(0, 20.0, 20_001)

    def make_dive(depth):
        command = 0.04 - depth * 0.5 * (1 - np.cos(2 * np.pi * time_s / 20.0))
        return Record.from_signals(time_s, {("z", Tap.CMD): command}, {"z": "m"})

    with pytest.raises(OutOfLimitsError, match="its floor"):
        machine.session.play(make_dive(3e-3))
    machine.session.play(make_dive(1e-3))
    assert machine.step_until(DeviceState.PLAYING).owners["x"] == "playback"
    with pytest.raises(RequestRefusedError):
        machine.session.go_to({"x": 0.03})


def test_the_floor_is_taught_at_the_tip(machine):
    floor = machine.session.bounds.teach_floor(1e-4)
    tip = machine.session.snapshot().tip
    assert floor == pytest.approx(tip[2] - 1e-4, abs=1e-12)
    with pytest.raises(OutOfLimitsError, match="its floor"):
        machine.session.jog("z", -2e-4)
    machine.session.jog("z", 2e-4)
    machine.step_until_idle()
    machine.session.bounds.clear_floor()
    machine.session.jog("z", -1e-2)


def test_an_expired_lease_halts_the_axis_without_a_fault(free_machine):
    free_machine.session.move_velocity({"x": 5e-3}, 0.1)
    assert free_machine.step(0.02).phase is SessionPhase.MOVING
    state = free_machine.step_until_idle()
    assert state.fault is None
    assert 0.1 * 5e-3 * 0.7 < state.command["x"] - 0.0275 <= 5e-3 * 0.1 + 1e-6


def test_a_speed_that_waited_too_long_is_not_executed(free_machine):
    free_machine.session.move_velocity({"x": 5e-3}, 0.1)
    free_machine.clock.advance(0.2)
    state = free_machine.step()
    assert (state.activity, state.command["x"]) == (DeviceState.IDLE, 0.0275)


def test_renewals_of_a_speed_replace_each_other_in_the_queue(free_machine):
    for speed in np.linspace(1e-3, 5e-3, 50):
        free_machine.session.move_velocity({"x": float(speed)}, 0.5)
    assert free_machine.session.snapshot().queued == 1


def test_an_axis_has_one_owner_until_it_rests(free_machine):
    session = free_machine.session
    session.go_to({"x": 0.03}, owner="joystick")
    assert free_machine.step().owners == {"x": "joystick"}
    with pytest.raises(RequestRefusedError, match="joystick controls axis x"):
        session.jog("x", 1e-3)
    session.jog("y", 1e-3)
    session.reservations.take_over(["x"], "operator")
    session.go_to({"x": 0.029})
    free_machine.step_until_idle()
    assert free_machine.step().owners == {}
    session.go_to({"x": 0.03}, owner="script")


def test_an_emergency_stop_halts_a_move_until_it_is_released(free_machine):
    session = free_machine.session
    session.go_to({"x": 0.05})
    free_machine.step(0.2)
    session.emergency_stop()
    state = free_machine.step_until_idle()
    assert "stop and lock is active" in state.lock_reason
    assert free_machine.step(1.0).command == state.command
    session.release()
    session.jog("x", 1e-3)


def test_a_barred_session_completes_its_move_and_then_refuses_motion_with_the_reason(free_machine):
    session = free_machine.session
    session.go_to({"x": 0.05})
    free_machine.step(0.2)
    session.bar_motion("a replay is shown")
    state = free_machine.step_until_idle()
    assert state.command["x"] == pytest.approx(0.05)
    assert state.lock_reason == "a replay is shown"
    for request in (
        lambda: session.jog("x", 1e-3),
        lambda: session.move_velocity({"x": 1e-3}),
        lambda: session.tool.switch(True),
        session.home,
        session.undo,
    ):
        with pytest.raises(RequestRefusedError, match="a replay is shown"):
            request()
    session.bar_motion(None)
    session.undo()


def test_the_phase_follows_the_motion_and_the_connection(free_machine):
    session, step = free_machine.session, free_machine.step
    assert session.snapshot().phase is SessionPhase.READY
    session.go_to({"x": 0.05})
    assert step(0.1, 2).phase is SessionPhase.MOVING
    session.stop()
    assert step(0.02).phase is SessionPhase.STOPPING
    assert free_machine.step_until_idle().phase is SessionPhase.READY
    session.disconnect()
    assert step().phase is SessionPhase.DISCONNECTED
    assert free_machine.driver.status().state is DeviceState.CLOSED
    session.reconnect()
    assert step(0.02, 2).phase is SessionPhase.READY
    session.close()
    assert session.snapshot().phase is SessionPhase.DISCONNECTED


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


def test_undo_returns_once_on_a_safe_path_and_not_on_another_device(free_machine):
    session = free_machine.session
    begin = session.snapshot().command
    assert not session.can_undo
    session.go_to({"x": 0.03, "z": 0.038})
    reached = free_machine.step_until_idle().command
    assert session.can_undo
    session.undo()
    assert free_machine.step_until_idle().command == begin
    window = session.history.tail()
    x, z = window.command[:, 0], window.command[:, 2]
    is_crossing = (x < reached["x"] - 1e-4) & (x > begin["x"] + 1e-4)
    is_returning = is_crossing & (np.arange(len(x)) > len(x) // 2)
    assert z[is_returning].min() >= max(begin["z"], reached["z"]) + 0.9e-3
    assert not session.can_undo
    with pytest.raises(RequestRefusedError, match="no previous position"):
        session.undo()
    session.jog("x", 1e-3)
    free_machine.step_until_idle()
    session.use_driver(Simulator(session.robot, clock=free_machine.clock))
    free_machine.step(times=3)
    assert not session.can_undo
    with pytest.raises(RequestRefusedError, match="no previous position"):
        session.undo()


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
    max_examples=25,
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
