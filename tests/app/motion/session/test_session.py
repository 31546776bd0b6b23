"""The session, stepped by the test: requests, refusals, events and failures."""

import threading
from datetime import datetime, timedelta

import numpy as np
import pytest
from tests.app.motion.event_log import EventLog

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.device import OPERATOR
from rotemina.app.motion.model import compute_fingerprint
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import (
    CommandRefused,
    ConnectionState,
    FaultRaised,
    PlaybackFinished,
    RunLabels,
    SessionPhase,
    StateChanged,
    StopRequest,
    StopRequested,
)
from rotemina.drivers.contract import (
    ConnectionLostError,
    DeviceResetError,
    DeviceState,
    DriverTimeoutError,
    StateError,
)
from rotemina.drivers.simulator import Simulator
from rotemina.sim.errors import OutOfLimitsError, TrajectoryError
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot
from rotemina.sim.trajectory import checked_trajectory as checked_module, dry_run
from rotemina.sim.trajectory.checked_trajectory import check_and_seal

NOON = datetime(2026, 1, 2, 12)


def make_swing(axis="x", start=0.02, distance=1e-3, unit="m", **metadata):
    time_s = 2.0 + np.arange(501) / 1000.0
    command = start + 0.5 * distance * (1 - np.cos(4 * np.pi * (time_s - 2.0)))
    return Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: unit}, metadata)


def test_before_connecting_motion_is_locked(make_harness):
    harness = make_harness(connect=False)
    state = harness.session.snapshot()
    assert state.connection is ConnectionState.DISCONNECTED
    assert state.age_s is None
    with pytest.raises(RequestRefusedError, match="not connected"):
        harness.session.go_to({"x": 0.03})
    harness.session.stop()


def test_after_connecting_the_position_is_known(harness):
    state = harness.session.snapshot()
    assert state.connection is ConnectionState.CONNECTED
    assert state.activity is DeviceState.IDLE
    assert state.position_known
    assert state.lock_reason is None
    assert state.command["x"] == 0.0275
    assert state.measured["x"] == pytest.approx(0.0275, abs=2e-7)
    connections = [event.state.connection for event in harness.list_events(StateChanged)]
    assert connections == [ConnectionState.CONNECTING, ConnectionState.CONNECTED]


def test_targets_are_reached_and_jogs_add_up_from_the_last_target(harness):
    harness.session.go_to({"x": 0.03, "thx": 1e-3})
    assert harness.step().activity is DeviceState.MOVING
    for _ in range(3):
        harness.session.jog("x", 1e-4)
        harness.step()
    state = harness.step_until_idle()
    assert state.command["x"] == pytest.approx(0.0303, abs=1e-15)
    assert state.command["thx"] == 1e-3


def test_after_a_stop_jogs_count_from_the_rest_position(harness):
    harness.session.go_to({"x": 0.05})
    harness.step(0.1, 5)
    harness.session.stop()
    rest_x = harness.step_until_idle().command["x"]
    harness.session.jog("x", 1e-3)
    assert harness.step_until_idle().command["x"] == rest_x + 1e-3


@pytest.mark.parametrize(
    ("request_", "message"),
    [
        (lambda s: s.go_to({"x": 0.03, "y": 0.06}), "axis y"),
        (lambda s: s.jog("x", 0.03), "axis x"),
        (lambda s: s.jog("elbow", 0.0), "elbow"),
        (lambda s: s.go_to({"x": float("nan")}), "finite"),
        (lambda s: s.go_to({"x": "0.03"}), "finite"),
        (lambda s: s.go_to({"x": 0.03}, speeds={"x": "0.01"}), "x"),
        (lambda s: s.go_to({"x": 0.03}, speeds={"q": 1.0}), "q"),
        (lambda s: s.play(make_swing(distance=0.02)), "speed"),
        (lambda s: s.play(make_swing("elbow")), "elbow"),
    ],
)
def test_an_impossible_motion_is_refused_at_once_and_changes_nothing(harness, request_, message):
    with pytest.raises((OutOfLimitsError, TrajectoryError), match=message):
        request_(harness.session)
    state = harness.step(0.1)
    assert (state.connection, state.command["x"]) == (ConnectionState.CONNECTED, 0.0275)
    harness.session.jog("x", 1e-4)
    assert harness.step_until_idle().command["x"] == 0.0275 + 1e-4


def test_a_full_queue_refuses_requests_and_keeps_the_owners(make_harness):
    harness = make_harness(queue_size=3)
    for _ in range(3):
        harness.session.jog("x", 1e-5)
    with pytest.raises(RequestRefusedError, match="3 commands are already waiting"):
        harness.session.go_to({"y": 0.03}, owner="joystick")
    state = harness.session.snapshot()
    assert (state.queued, state.owners) == (3, {"x": "operator"})
    harness.step_until_idle()
    assert harness.session.snapshot().command["x"] == pytest.approx(0.0275 + 3e-5, abs=1e-15)


def test_a_playback_returns_its_record(harness):
    trajectory = make_swing(trajectory="there and back", history="unknown")
    harness.session.labels = RunLabels("series 3", "A. Müller")
    start = datetime.now().astimezone()
    harness.session.play(trajectory)
    assert harness.step().activity is DeviceState.PLAYING
    harness.step_until_idle()
    (finished,) = harness.list_events(PlaybackFinished)
    assert finished.completed
    record = finished.record
    np.testing.assert_allclose(record.time_s, trajectory.time_s - 2.0, rtol=0, atol=1e-9)
    np.testing.assert_array_equal(record.signal("x", Tap.CMD), trajectory.signal("x", Tap.CMD))
    assert [str(column) for column in record.columns] == ["x.cmd", "x.meas"]
    metadata = dict(record.metadata)
    began = datetime.fromisoformat(metadata.pop("began"))
    assert timedelta(milliseconds=-1) <= began - start < timedelta(minutes=5)
    assert metadata == {
        "mode": "open_loop",
        "history": "unknown",
        "robot": "RoTeMiNa",
        "driver": "unruly",
        "trajectory": "there and back",
        "trajectory_rows": "501",
        "trajectory_duration_s": "0.5",
        "trajectory_digest": check_and_seal(harness.session.robot, trajectory, 1e-3).digest,
        "model": harness.session.model.id,
        "robot_sha256": compute_fingerprint(harness.session.robot),
        "machine_kind": "simulated",
        "run": "series 3",
        "operator": "A. Müller",
    }
    assert harness.session.snapshot().progress == 1.0


def test_a_piezo_and_a_controlled_axis_record_their_voltage(harness, make_harness):
    harness.session.play(make_swing("zn", 20e-6, 1e-6))
    harness.step_until_idle()
    record = harness.list_events(PlaybackFinished)[0].record
    np.testing.assert_allclose(record.signal("zn", Tap.U), record.signal("zn", Tap.CMD) / 5e-7)
    emps = make_harness("emps")
    emps.session.play(make_swing("q", 0.1, 0.01))
    emps.step_until_idle()
    record = emps.list_events(PlaybackFinished)[0].record
    assert record.closed_loop
    assert np.ptp(record.signal("q", Tap.U)) > 0.1


def test_only_a_resting_machine_plays_and_while_playing_nothing_else_moves(harness):
    harness.session.go_to({"x": 0.03})
    for _ in range(2):
        with pytest.raises(RequestRefusedError, match="still moving"):
            harness.session.play(make_swing())
        harness.step()
    harness.step_until_idle()
    harness.session.play(make_swing())
    for _ in range(2):
        for request in (
            lambda: harness.session.jog("y", 1e-4),
            lambda: harness.session.go_to({"y": 0.01}),
            lambda: harness.session.play(make_swing()),
        ):
            with pytest.raises(RequestRefusedError, match="playing"):
                request()
        harness.step()
    harness.step_until_idle()
    assert harness.list_events(PlaybackFinished)[0].completed


def test_stop_ends_a_playback_and_returns_the_played_part(harness):
    harness.session.play(make_swing(start=0.0275))
    harness.step(0.01, 70)
    harness.session.stop()
    state = harness.step_until_idle()
    (finished,) = harness.list_events(PlaybackFinished)
    assert not finished.completed
    assert 0 < len(finished.record.time_s) < 501
    assert finished.record.time_s[0] == 0.0
    assert state.command["x"] != 0.0275
    assert state.lock_reason is None


def test_stop_before_the_first_row_returns_no_record(harness):
    harness.session.play(make_swing())
    harness.step(0.01, 3)
    harness.session.stop()
    harness.step_until_idle()
    (finished,) = harness.list_events(PlaybackFinished)
    assert (finished.record, finished.completed, finished.model_outputs) == (None, False, None)


def test_stop_drops_queued_requests_and_is_measured(harness):
    harness.session.go_to({"x": 0.05})
    harness.step(0.1, 5)
    harness.session.go_to({"x": 0.01})
    harness.session.stop()
    assert harness.session.snapshot().stop_latency_s is None  # not confirmed yet
    harness.step()
    assert harness.session.snapshot().standstill_s is None
    state = harness.step_until_idle()
    assert state.queued == 0
    assert state.command["x"] > 0.03
    assert state.stop_latency_s == pytest.approx(0.02)  # at the next exchange
    assert 0.05 <= state.standstill_s <= 0.1


def test_a_stop_overtakes_a_command_that_is_being_handed_over(harness):
    """A stop from another thread comes while a move is handed over to the driver."""
    harness.driver.before["move_to"] = harness.session.stop
    harness.session.go_to({"x": 0.05})
    harness.step()
    state = harness.step_until_idle()
    assert state.command["x"] == 0.0275  # the move did not reach the machine


@pytest.mark.parametrize("repeated", [False, True])
def test_a_failing_stop_does_not_raise_and_is_reported_even_after_a_successful_one(
    harness, repeated
):
    harness.driver.fail("stop", ConnectionLostError("cable pulled"))
    harness.session.stop()
    if repeated:
        harness.driver.before.clear()
        harness.session.stop()
    state = harness.step()
    assert state.connection is ConnectionState.FAILED
    assert "cable pulled" in state.fault


def test_a_trajectory_is_checked_once(harness, monkeypatch):
    checked = dry_run(harness.session.robot, make_swing()).require()
    calls, check = [], checked_module.check_trajectory
    monkeypatch.setattr(
        checked_module,
        "check_trajectory",
        lambda *args, **kwargs: calls.append(args) or check(*args, **kwargs),
    )
    for trajectory, expected in ((checked, 0), (make_swing(), 1)):
        harness.session.play(trajectory)
        harness.step_until_idle()
        assert harness.list_events(PlaybackFinished)[-1].completed
        assert len(calls) == expected


@pytest.mark.parametrize(
    ("hook", "error"),
    [
        ("read", ConnectionLostError("cable pulled")),
        ("read", RuntimeError("bug")),
        ("move_to", DriverTimeoutError("no answer")),
    ],
)
def test_a_failing_driver_locks_motion_until_reconnected(harness, hook, error):
    harness.session.go_to({"x": 0.03})
    harness.driver.fail(hook, error)
    state = harness.step()
    assert state.connection is ConnectionState.FAILED
    assert state.activity is DeviceState.CLOSED
    assert not state.position_known
    assert str(error) in state.fault
    assert "x" in state.measured
    (fault,) = harness.list_events(FaultRaised)
    assert str(error) in fault.message
    assert harness.driver.status().state is DeviceState.CLOSED
    harness.driver.before.clear()
    assert harness.step(0.1, 10).connection is ConnectionState.FAILED
    for request in (lambda: harness.session.jog("x", 1e-4), harness.session.service.clear_fault):
        with pytest.raises(RequestRefusedError, match="reconnect"):
            request()
    harness.session.reconnect()
    state = harness.step()
    assert state.connection is ConnectionState.CONNECTED
    assert state.fault is None
    with pytest.raises(RequestRefusedError, match="home, or confirm it"):
        harness.session.jog("x", 1e-4)
    harness.session.confirm_position()
    harness.step()
    harness.session.jog("x", 1e-4)
    harness.step_until_idle()
    with pytest.raises(RequestRefusedError, match="is connected"):
        harness.session.reconnect()


def test_a_failure_ends_a_playback_with_a_partial_record(harness):
    harness.session.play(make_swing())
    harness.step(0.05, 30)
    harness.driver.fail("read", ConnectionLostError("cable pulled"))
    harness.step()
    (finished,) = harness.list_events(PlaybackFinished)
    assert not finished.completed
    assert len(finished.record.time_s) > 100


def test_an_unreachable_device_fails_and_can_be_reconnected(make_harness):
    harness = make_harness(connect=False)
    harness.driver.fail("open", ConnectionLostError("no such port"))
    harness.connect()
    assert harness.session.snapshot().connection is ConnectionState.FAILED
    harness.driver.before.clear()
    harness.session.reconnect()
    assert harness.step().connection is ConnectionState.CONNECTED


def test_a_refusal_of_the_device_is_reported_and_keeps_the_targets_of_all_axes(harness):
    harness.session.go_to({"x": 0.05, "y": 0.03})
    harness.step(0.1, 2)
    harness.driver.fail("move_to", StateError("door open"))
    harness.session.go_to({"x": 0.04})
    state = harness.step()
    assert [event.message for event in harness.list_events(CommandRefused)] == ["door open"]
    assert state.connection is ConnectionState.CONNECTED
    assert state.lock_reason is None
    harness.driver.before.clear()
    harness.session.jog("x", 1e-3)
    harness.session.jog("y", 1e-3)
    state = harness.step_until_idle()
    assert state.command["x"] == pytest.approx(0.051, abs=1e-15)
    assert state.command["y"] == pytest.approx(0.031, abs=1e-15)


def test_a_jog_during_a_hand_over_counts_from_the_new_target(harness):
    """Another thread jogs while a move is handed over to the driver."""

    def jog_once():
        harness.driver.before.clear()
        harness.session.jog("x", 1e-3)

    harness.driver.before["move_to"] = jog_once
    harness.session.go_to({"x": 0.03})
    assert harness.step_until_idle().command["x"] == pytest.approx(0.031, abs=1e-15)


def test_a_silent_device_locks_motion(harness):
    harness.step()
    harness.clock.advance(3.0)  # while the worker hangs in the driver
    state = harness.session.snapshot()
    assert state.age_s == pytest.approx(3.0)
    assert state.silent_s == pytest.approx(3.0, abs=0.1)
    assert state.phase is SessionPhase.SHORT_LOSS
    assert "nothing for 3.0 s" in state.lock_reason
    with pytest.raises(RequestRefusedError, match="locked"):
        harness.session.jog("x", 1e-4)
    harness.session.run_once()
    assert harness.session.snapshot().lock_reason is None


def test_a_device_fault_locks_until_it_is_cleared(harness):
    harness.driver._fault = "over-temperature"
    state = harness.step(times=3)
    assert state.connection is ConnectionState.CONNECTED
    assert "over-temperature" in state.lock_reason
    assert [event.message for event in harness.list_events(FaultRaised)] == ["over-temperature"]
    with pytest.raises(RequestRefusedError, match="over-temperature"):
        harness.session.jog("x", 1e-6)
    harness.driver._fault = None
    assert "over-temperature" in harness.step().lock_reason
    harness.driver._fault = "over-temperature"
    harness.session.service.clear_fault()
    assert harness.step().lock_reason is None


def test_a_failing_subscriber_is_logged_and_the_others_are_called(harness, caplog):
    harness.session.subscribe(lambda event: 1 / 0)
    events = []
    unsubscribe = harness.session.subscribe(events.append)
    harness.session.jog("x", 1e-4)
    harness.step()
    assert "ZeroDivisionError" in caplog.text
    assert len(events) == 1
    unsubscribe()
    unsubscribe()
    harness.step_until_idle()
    assert len(events) == 1


def test_a_subscriber_may_start_the_next_playback(harness):
    runs = []

    def play_again(event):
        if isinstance(event, PlaybackFinished):
            runs.append(event.completed)
            if len(runs) < 2:
                harness.session.play(make_swing())

    harness.session.subscribe(play_again)
    harness.session.play(make_swing())
    for _ in range(400):
        harness.step(0.02)
    assert runs == [True, True]


def test_closing_ends_a_playback_and_can_be_repeated(harness):
    harness.session.play(make_swing())
    harness.step(0.05, 30)
    assert harness.session.close()
    assert harness.session.close()
    assert not harness.list_events(PlaybackFinished)[0].completed
    assert harness.session.snapshot().connection is ConnectionState.DISCONNECTED
    assert harness.driver.status().state is DeviceState.CLOSED


def test_a_session_runs_on_its_own_thread():
    session = MotionSession(Simulator(load_robot("rotemina"), {"settle_s": 0.01}))
    thread_names = set()
    session.subscribe(lambda _: thread_names.add(threading.current_thread().name))
    log = EventLog(session)
    session.start()
    with pytest.raises(RequestRefusedError, match="already been started"):
        session.start()
    try:
        log.wait_until(lambda: session.snapshot().lock_reason is None)
        session.go_to({"x": 0.05})
        log.wait_until(lambda: session.snapshot().activity is DeviceState.MOVING)
        session.stop()
        log.wait_until(lambda: session.snapshot().standstill_s is not None)
        state = session.snapshot()
        assert state.command["x"] < 0.05
        assert 0.0 <= state.stop_latency_s <= state.standstill_s
        log.wait_until(lambda: session.at_rest)
        session.play(make_swing(start=state.command["x"], distance=1e-4))
        log.wait_until(lambda: log.list_events(PlaybackFinished))
        assert log.list_events(PlaybackFinished)[0].completed
    finally:
        assert session.close()
    assert thread_names == {"motion session"}
    assert len(session.history.tail(0.2)) > 100
    assert "motion session" not in {thread.name for thread in threading.enumerate()}


def test_a_stop_is_reported_with_origin_reason_and_time_even_by_a_failed_device(make_harness):
    harness = make_harness(local_time=lambda: NOON)
    session = harness.session
    assert session.snapshot().stop is None
    session.stop(by=OPERATOR)
    assert session.snapshot().stop == StopRequest("operator", "", NOON)
    session.stop("the window does not respond")
    session.emergency_stop(by=OPERATOR)
    harness.step()
    assert [str(event.request) for event in harness.list_events(StopRequested)] == [
        "Stopped by the operator at 12:00:00",
        "Stopped by the program at 12:00:00: the window does not respond",
        "Stopped by the operator at 12:00:00: stop and lock",
    ]
    harness.driver.fail("read", ConnectionLostError("cable pulled"))
    harness.step()
    session.stop(by=OPERATOR)
    harness.step()
    assert len(harness.list_events(StopRequested)) == 4


def test_the_state_is_halted_until_the_next_motion_or_accepted_request(harness):
    session = harness.session
    harness.step()
    assert not session.snapshot().halted
    for operate in (
        lambda: session.jog("x", 1e-4),
        session.release,
        session.dismiss_stop,
        # By the buttons of the device.
        lambda: harness.driver.move_to({"x": 0.03}, permit=session.permit()),
    ):
        session.go_to({"x": 0.02}, speeds={"x": 1e-3})
        old_permit = session.permit()
        harness.step()
        session.stop()
        assert session.snapshot().halted
        harness.step_until_idle()
        harness.step(0.02, 5)
        assert session.snapshot().halted
        with pytest.raises(RequestRefusedError):
            session.go_to({"x": 0.02}, permit=old_permit)
        harness.step()
        assert session.snapshot().halted
        operate()
        harness.step()
        assert not session.snapshot().halted
        harness.step_until_idle()
        assert not session.snapshot().halted


def test_a_lost_link_is_distinguished_from_a_failed_device(make_harness):
    for error, is_link_lost in (
        (ConnectionError("unplugged"), True),
        (DeviceResetError("the board began again"), False),
        (ValueError("a bug"), False),
    ):
        harness = make_harness()
        harness.driver.fail("read", error)
        assert harness.step().link_lost is is_link_lost
    never_connected = make_harness(connect=False)
    never_connected.driver.fail("open", ConnectionError("no such port"))
    assert never_connected.connect().step().link_lost is False
