"""What a session lets through: the tip's bounds, owners, leases, latches, the way back."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.state import Phase
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.errors import InputError
from rotemina.sim.kinematics.keep_out import SLOW_HEIGHT, SLOW_SPEED
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import KeepOut
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError

FLOOR = -2e-3
ROBOT = replace(load_robot("rotemina"), keep_out=KeepOut(floor=FLOOR, radius=0.02))


@pytest.fixture
def bounded(make_stepped):
    return make_stepped(ROBOT, driver=Simulator)


@pytest.fixture
def free(make_stepped):
    stepped = make_stepped(driver=Simulator)
    stepped.step()
    return stepped


def heights(stepped):
    window = stepped.session.history.tail()
    return window.device_time_s, stepped.session.bounds.keep_out.tip(window.command)[:, 2]


def test_a_move_below_the_floor_is_refused_with_the_reason(bounded):
    bounded.step()
    with pytest.raises(OutOfLimitsError, match=r"its floor is -2 mm"):
        bounded.session.go_to({"z": 0.03})
    with pytest.raises(OutOfLimitsError, match="from the middle"):
        bounded.session.go_to({"x": 0.05})
    with pytest.raises(OutOfLimitsError, match="its floor"):
        bounded.session.jog("z", -3e-3)
    assert bounded.step().activity is DeviceState.IDLE


def test_a_move_into_the_slow_zone_slows_down_and_arrives(bounded):
    bounded.step()
    bounded.session.go_to({"z": 0.0383})
    bounded.until_idle()
    time_s, height = heights(bounded)
    assert bounded.session.snapshot().command["z"] == 0.0383
    down = -np.gradient(height, time_s)
    assert (down[height < FLOOR + 0.9 * SLOW_HEIGHT] <= 1.01 * SLOW_SPEED).all()
    assert down.max() > 4 * SLOW_SPEED
    assert height.min() >= FLOOR


def test_a_stop_between_the_legs_of_a_move_ends_it(bounded):
    bounded.step()
    bounded.session.go_to({"z": 0.0383})
    bounded.step(0.1)
    bounded.session.stop()
    state = bounded.until_idle()
    rested = state.command["z"]
    assert bounded.step(1.0, 3).command["z"] == rested


def test_driving_down_ends_above_the_floor(bounded):
    bounded.step()
    refused = False
    for _ in range(2000):
        try:
            bounded.session.move_velocity({"z": -2e-3, "x": 1e-3}, 0.1)
        except OutOfLimitsError:
            refused = True
            break
        bounded.step(0.02)
    assert refused
    bounded.until_idle()
    time_s, height = heights(bounded)
    assert FLOOR <= height.min() <= FLOOR + 2e-4
    down = -np.gradient(height, time_s)
    assert (down[height < FLOOR + 0.9 * SLOW_HEIGHT] <= 1.01 * SLOW_SPEED).all()


def test_a_trajectory_below_the_floor_is_refused_and_one_above_plays(bounded):
    bounded.step()
    time_s = np.linspace(0, 20.0, 20_001)

    def dive(depth):
        command = 0.04 - depth * 0.5 * (1 - np.cos(2 * np.pi * time_s / 20.0))
        return Record.from_signals(time_s, {("z", Tap.CMD): command}, {"z": "m"})

    with pytest.raises(OutOfLimitsError, match="its floor"):
        bounded.session.play(dive(3e-3))
    bounded.session.play(dive(1e-3))
    assert bounded.until(DeviceState.PLAYING).owners["x"] == "playback"
    with pytest.raises(RefusedError):
        bounded.session.go_to({"x": 0.03})


def test_the_floor_is_taught_where_the_tip_is(bounded):
    bounded.step()
    floor = bounded.session.bounds.teach_floor(1e-4)
    tip = bounded.session.snapshot().tip
    assert floor == pytest.approx(tip[2] - 1e-4, abs=1e-12)
    with pytest.raises(OutOfLimitsError, match="its floor"):
        bounded.session.jog("z", -2e-4)
    bounded.session.jog("z", 2e-4)
    bounded.until_idle()
    bounded.session.bounds.clear_floor()
    bounded.session.jog("z", -1e-2)


def test_a_lease_that_nobody_renews_halts_the_axis_without_a_fault(free):
    free.session.move_velocity({"x": 5e-3}, 0.1)
    free.step(0.02)
    assert free.session.snapshot().phase is Phase.MOVING
    state = free.until_idle()
    assert state.fault is None
    way = state.command["x"] - 0.0275
    assert 0.1 * 5e-3 * 0.7 < way <= 5e-3 * 0.1 + 1e-6


def test_a_speed_that_waited_too_long_is_not_begun(free):
    free.session.move_velocity({"x": 5e-3}, 0.1)
    free.clock.advance(0.2)
    assert free.step().activity is DeviceState.IDLE
    assert free.session.snapshot().command["x"] == 0.0275


def test_renewals_replace_each_other_in_the_queue(free):
    for speed in np.linspace(1e-3, 5e-3, 50):
        free.session.move_velocity({"x": float(speed)}, 0.5)
    assert free.session.snapshot().queued == 1


def test_an_axis_has_one_owner_until_it_rests(free):
    free.session.go_to({"x": 0.03}, owner="joystick")
    free.step()
    assert free.session.snapshot().owners == {"x": "joystick"}
    with pytest.raises(RefusedError, match="joystick controls axis x"):
        free.session.jog("x", 1e-3)
    free.session.jog("y", 1e-3)
    free.session.reservations.take_over(["x"], "operator")
    free.session.go_to({"x": 0.029})
    free.until_idle()
    assert free.step().owners == {}
    free.session.go_to({"x": 0.03}, owner="script")


def test_an_emergency_stop_stays_until_it_is_released(free):
    free.session.go_to({"x": 0.05})
    free.step(0.2)
    free.session.emergency_stop()
    state = free.until_idle()
    assert "stop and lock is active" in state.locked
    for request in (
        lambda: free.session.jog("x", 1e-3),
        lambda: free.session.move_velocity({"x": 1e-3}),
        free.session.home,
        free.session.undo,
    ):
        with pytest.raises(RefusedError, match="release it first"):
            request()
    assert free.step(1.0).command == state.command
    free.session.release()
    free.session.jog("x", 1e-3)


def test_a_barred_session_moves_on_no_path_and_says_why(free):
    free.session.go_to({"x": 0.05})
    free.step(0.2)
    free.session.bar("a replay is shown")
    reached = free.until_idle()
    assert reached.command["x"] == pytest.approx(0.05)  # what was under way goes on
    assert reached.locked == "a replay is shown"
    for request in (
        lambda: free.session.jog("x", 1e-3),
        lambda: free.session.move_velocity({"x": 1e-3}),
        free.session.home,
        free.session.undo,
    ):
        with pytest.raises(RefusedError, match="a replay is shown"):
            request()
    free.session.bar(None)
    free.session.undo()


def test_phases_name_what_matters(free):
    assert free.session.snapshot().phase is Phase.READY
    free.session.go_to({"x": 0.05})
    assert free.step(0.1, 2).phase is Phase.MOVING
    free.session.stop()
    assert free.step(0.02).phase is Phase.STOPPING
    free.until_idle()
    assert free.session.snapshot().phase is Phase.READY
    free.session.close()
    assert free.session.snapshot().phase is Phase.DISCONNECTED


def test_an_unknown_position_locks_motion_until_homed(make_stepped):
    stepped = make_stepped(driver=Simulator, settings={"start_homed": False})
    state = stepped.step()
    assert state.phase is Phase.POSITION_UNKNOWN
    with pytest.raises(RefusedError, match="home first"):
        stepped.session.jog("x", 1e-3)
    stepped.session.home()
    assert stepped.step(0.1).activity is DeviceState.HOMING
    with pytest.raises(RefusedError, match="wait before homing"):
        stepped.session.home()
    with pytest.raises(RefusedError, match="home first"):
        stepped.session.jog("x", 1e-3)
    state = stepped.until_idle()
    assert state.phase is Phase.READY
    stepped.session.jog("x", 1e-3)


def test_undo_goes_back_by_a_safe_way(free):
    begin = free.session.snapshot().command
    free.session.go_to({"x": 0.03, "z": 0.038})
    there = free.until_idle().command
    free.session.undo()
    free.until_idle()
    assert free.session.snapshot().command == begin
    window = free.session.history.tail()
    x, z = window.command[:, 0], window.command[:, 2]
    across = (x < there["x"] - 1e-4) & (x > begin["x"] + 1e-4)
    back = across & (np.arange(len(x)) > len(x) // 2)
    assert z[back].min() >= max(begin["z"], there["z"]) + 0.9e-3
    with pytest.raises(RefusedError, match="no previous position"):
        free.session.undo()


def test_whether_there_is_a_move_to_take_back_is_known_and_ends_with_the_device(free):
    assert not free.session.undoable
    free.session.jog("x", 1e-3)
    free.until_idle()
    assert free.session.undoable
    free.session.undo()
    free.until_idle()
    assert not free.session.undoable
    free.session.jog("x", 1e-3)
    free.until_idle()
    free.session.use(Simulator(free.driver.robot, clock=free.clock))
    free.step(times=3)
    assert not free.session.undoable
    with pytest.raises(RefusedError, match="no previous position"):
        free.session.undo()


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
def test_no_sequence_of_requests_leaves_the_bounds(stepped_type, requests):
    clock = VirtualClock(1.0)
    stepped = stepped_type(Simulator(ROBOT, clock=clock), clock).connect()
    stepped.step()
    for kind, value in requests:
        try:
            if kind == "go":
                stepped.session.go_to(value)
            elif kind == "drive":
                stepped.session.move_velocity(value, 0.2)
            elif kind == "undo":
                stepped.session.undo()
            elif kind == "stop":
                stepped.session.stop()
        except InputError:
            pass
        stepped.step(value if kind == "wait" else 0.03)
    stepped.step(0.1, 30)
    window = stepped.session.history.tail()
    for column, axis in enumerate(ROBOT.axes.values()):
        assert window.command[:, column].min() >= axis.range[0]
        assert window.command[:, column].max() <= axis.range[1]
    tip = stepped.session.bounds.keep_out.tip(window.command)
    middle = stepped.session.bounds.keep_out.tip(
        np.array([sum(axis.range) / 2 for axis in ROBOT.axes.values()])
    )
    assert tip[:, 2].min() >= FLOOR - 1e-9
    assert np.hypot(*(tip - middle)[:, :2].T).max() <= 0.02 + 1e-9


def test_another_driver_takes_the_place_of_the_first(free, clock):
    first = free.driver
    free.session.go_to({"x": 0.05})
    free.step(0.1, 2)
    second = Simulator(load_robot("rotemina"), {"start_fraction": 0.25}, clock=clock)
    free.session.use(second)
    state = free.step(0.02, 2)
    assert first.status().state is DeviceState.CLOSED
    assert state.command["x"] == pytest.approx(0.055 / 4)
    free.session.jog("x", 1e-3)
    assert free.until_idle().command["x"] == pytest.approx(0.055 / 4 + 1e-3)
    with pytest.raises(RefusedError, match="start the program with that robot"):
        free.session.use(Simulator(load_robot("picma"), clock=clock))


def test_a_session_lets_go_and_connects_again(free):
    free.session.disconnect()
    state = free.step(0.02)
    assert state.phase is Phase.DISCONNECTED
    assert free.driver.status().state is DeviceState.CLOSED
    free.session.reconnect()
    assert free.step(0.02, 2).phase is Phase.READY


def test_a_refused_request_leaves_the_owners_as_they_were(make_stepped):
    stepped = make_stepped(driver=Simulator, queue_size=1)
    stepped.step()
    stepped.session.go_to({"x": 0.03}, owner="script")
    with pytest.raises(RefusedError, match="already waiting"):
        stepped.session.go_to({"y": 0.03}, owner="joystick")
    assert stepped.session.snapshot().owners == {"x": "script"}
