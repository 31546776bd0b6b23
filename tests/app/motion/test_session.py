"""The session, stepped by hand: what it accepts, refuses, tells and survives."""

import threading
from datetime import datetime, timedelta

import numpy as np
import pytest

from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.model_in_use import fingerprint
from rotemina.app.motion.ownership import OPERATOR
from rotemina.app.motion.run_labels import RunLabels
from rotemina.app.motion.state import (
    CommandRefused,
    Connection,
    Faulted,
    Phase,
    PlaybackFinished,
    StateChanged,
    Stopped,
)
from rotemina.app.motion.stop import StopRequest
from rotemina.drivers.driver import Driver
from rotemina.drivers.errors import (
    ConnectionLostError,
    DeviceResetError,
    DriverTimeoutError,
    StateError,
)
from rotemina.drivers.samples import DeviceState, DeviceStatus, Samples
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.trajectory import checked_trajectory as checked_module
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError
from rotemina.sim.trajectory.checked_trajectory import check
from rotemina.sim.trajectory.dry_run import dry_run
from rotemina.sim.trajectory.trajectory_excesses import TrajectoryError

NOON = datetime(2026, 1, 2, 12)


def there_and_back(axis="x", start=0.02, distance=1e-3, unit="m", **metadata):
    time_s = 2.0 + np.arange(501) / 1000.0
    command = start + 0.5 * distance * (1 - np.cos(4 * np.pi * (time_s - 2.0)))
    return Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: unit}, metadata)


def raising(error):
    def hook():
        raise error

    return hook


def test_before_connecting_motion_is_locked(make_stepped):
    made = make_stepped(connect=False)
    state = made.session.snapshot()
    assert state.connection is Connection.DISCONNECTED
    assert state.age_s is None
    with pytest.raises(RefusedError, match="not connected"):
        made.session.go_to({"x": 0.03})
    made.session.stop()


def test_connecting_knows_the_position(stepped):
    state = stepped.session.snapshot()
    assert state.connection is Connection.CONNECTED
    assert state.activity is DeviceState.IDLE
    assert state.position_known
    assert state.locked is None
    assert state.command["x"] == 0.0275
    assert state.measured["x"] == pytest.approx(0.0275, abs=2e-7)
    told = [event.state.connection for event in stepped.told(StateChanged)]
    assert told == [Connection.CONNECTING, Connection.CONNECTED]


def test_go_to_arrives(stepped):
    stepped.session.go_to({"x": 0.03, "thx": 1e-3})
    assert stepped.step().activity is DeviceState.MOVING
    state = stepped.until_idle()
    assert state.command["x"] == 0.03
    assert state.command["thx"] == 1e-3


def test_jogs_add_up_from_the_last_target(stepped):
    for _ in range(3):
        stepped.session.jog("x", 1e-4)
        stepped.step()
    state = stepped.until_idle()
    assert state.command["x"] == pytest.approx(0.0278, abs=1e-15)


def test_after_a_stop_jogs_count_from_where_it_stands(stepped):
    stepped.session.go_to({"x": 0.05})
    stepped.step(0.1, 5)
    stepped.session.stop()
    stood = stepped.until_idle().command["x"]
    stepped.session.jog("x", 1e-3)
    assert stepped.until_idle().command["x"] == stood + 1e-3


@pytest.mark.parametrize(
    ("request_", "words"),
    [
        (lambda s: s.go_to({"x": 0.03, "y": 0.06}), "axis y"),
        (lambda s: s.jog("x", 0.03), "axis x"),
        (lambda s: s.jog("elbow", 0.0), "elbow"),
        (lambda s: s.go_to({"x": float("nan")}), "finite"),
        (lambda s: s.play(there_and_back(distance=0.02)), "speed"),
    ],
)
def test_limits_are_refused_at_once_with_the_reason(stepped, request_, words):
    with pytest.raises(OutOfLimitsError, match=words):
        request_(stepped.session)
    before = stepped.session.snapshot().command
    assert stepped.step(0.1).command == before


def test_a_refused_jog_leaves_the_target_alone(stepped):
    with pytest.raises(InputError):
        stepped.session.jog("x", 1.0)
    stepped.session.jog("x", 1e-4)
    assert stepped.until_idle().command["x"] == 0.0275 + 1e-4


def test_a_full_queue_refuses(make_stepped):
    made = make_stepped(queue_size=3)
    for _ in range(3):
        made.session.jog("x", 1e-5)
    with pytest.raises(RefusedError, match="3 commands are already waiting"):
        made.session.jog("x", 1e-5)
    assert made.session.snapshot().queued == 3
    made.until_idle()
    assert made.session.snapshot().command["x"] == pytest.approx(0.0275 + 3e-5, abs=1e-15)


def test_a_playback_gives_its_record(stepped):
    trajectory = there_and_back(trajectory="there and back", history="unknown")
    stepped.session.labels = RunLabels("series 3", "A. Müller")
    before = datetime.now().astimezone()
    stepped.session.play(trajectory)
    assert stepped.step().activity is DeviceState.PLAYING
    stepped.until_idle()
    (finished,) = stepped.told(PlaybackFinished)
    assert finished.completed
    record = finished.record
    np.testing.assert_allclose(record.time_s, trajectory.time_s - 2.0, rtol=0, atol=1e-9)
    np.testing.assert_array_equal(record.signal("x", Tap.CMD), trajectory.signal("x", Tap.CMD))
    assert [str(column) for column in record.columns] == ["x.cmd", "x.meas"]
    said = dict(record.metadata)
    began = datetime.fromisoformat(said.pop("began"))
    assert timedelta(milliseconds=-1) <= began - before < timedelta(minutes=5)
    assert said == {
        "mode": "open_loop",
        "history": "unknown",
        "robot": "RoTeMiNa",
        "driver": "unruly",
        "trajectory": "there and back",
        "trajectory_rows": "501",
        "trajectory_duration_s": "0.5",
        "trajectory_digest": check(stepped.session.robot, trajectory, 1e-3).digest,
        "model": stepped.session.model.id,
        "robot_sha256": fingerprint(stepped.session.robot),
        "machine_kind": "simulated",
        "run": "series 3",
        "operator": "A. Müller",
    }
    assert stepped.session.snapshot().progress == 1.0


def test_a_piezo_and_a_controlled_axis_record_their_voltage(stepped, make_stepped):
    stepped.session.play(there_and_back("zn", 20e-6, 1e-6))
    stepped.until_idle()
    record = stepped.told(PlaybackFinished)[0].record
    np.testing.assert_allclose(record.signal("zn", Tap.U), record.signal("zn", Tap.CMD) / 5e-7)
    emps = make_stepped("emps")
    emps.session.play(there_and_back("q", 0.1, 0.01))
    emps.until_idle()
    record = emps.told(PlaybackFinished)[0].record
    assert record.closed_loop
    assert np.ptp(record.signal("q", Tap.U)) > 0.1


def test_while_playing_nothing_else_moves(stepped):
    stepped.session.play(there_and_back())
    for _ in range(2):
        for request in (
            lambda: stepped.session.jog("y", 1e-4),
            lambda: stepped.session.go_to({"y": 0.01}),
            lambda: stepped.session.play(there_and_back()),
        ):
            with pytest.raises(RefusedError, match="playing"):
                request()
        stepped.step()
    stepped.until_idle()
    assert stepped.told(PlaybackFinished)[0].completed


def test_a_moving_machine_does_not_begin_to_play(stepped):
    stepped.session.go_to({"x": 0.03})
    with pytest.raises(RefusedError, match="still moving"):
        stepped.session.play(there_and_back())
    stepped.step()
    with pytest.raises(RefusedError, match="still moving"):
        stepped.session.play(there_and_back())


def test_stop_ends_a_playback_and_gives_what_was_played(stepped):
    stepped.session.play(there_and_back(start=0.0275))
    stepped.step(0.01, 70)
    stepped.session.stop()
    state = stepped.until_idle()
    (finished,) = stepped.told(PlaybackFinished)
    assert not finished.completed
    assert 0 < len(finished.record.time_s) < 501
    assert finished.record.time_s[0] == 0.0
    assert state.command["x"] != 0.0275
    assert state.locked is None


def test_stop_on_the_way_to_the_first_row_gives_no_record(stepped):
    stepped.session.play(there_and_back())
    stepped.step(0.01, 3)
    stepped.session.stop()
    stepped.until_idle()
    (finished,) = stepped.told(PlaybackFinished)
    assert (finished.record, finished.completed, finished.answers) == (None, False, None)


def test_stop_drops_what_is_queued_and_is_measured(stepped):
    stepped.session.go_to({"x": 0.05})
    stepped.step(0.1, 5)
    stepped.session.go_to({"x": 0.01})
    stepped.session.stop()
    assert stepped.session.snapshot().stop_latency_s is None  # not confirmed yet
    stepped.step()
    assert stepped.session.snapshot().standstill_s is None
    state = stepped.until_idle()
    assert state.queued == 0
    assert state.command["x"] > 0.03
    assert state.stop_latency_s == pytest.approx(0.02)  # with the next exchange
    assert 0.05 <= state.standstill_s <= 0.1


def test_a_command_on_its_way_does_not_undo_a_stop(stepped):
    """A stop from another thread falls into the very moment in which a move is handed over."""
    stepped.driver.before["move_to"] = stepped.session.stop
    stepped.session.go_to({"x": 0.05})
    stepped.step()
    state = stepped.until_idle()
    assert state.command["x"] == 0.0275  # nothing of it reached the machine


def test_stop_neither_waits_nor_raises(stepped):
    stepped.driver.before["stop"] = raising(ConnectionLostError("cable pulled"))
    stepped.session.stop()
    state = stepped.step()
    assert state.connection is Connection.FAILED
    assert "cable pulled" in state.fault


def test_a_stop_that_succeeds_does_not_hide_one_that_failed(stepped):
    stepped.driver.before["stop"] = raising(ConnectionLostError("cable pulled"))
    stepped.session.stop()
    stepped.driver.before.clear()
    stepped.session.stop()
    state = stepped.step()
    assert state.connection is Connection.FAILED
    assert "cable pulled" in state.fault


def test_what_was_checked_is_not_checked_again(stepped, monkeypatch):
    checked = dry_run(stepped.session.robot, there_and_back()).require()

    def again(*_, **__):
        raise AssertionError("checked again")

    monkeypatch.setattr("rotemina.sim.trajectory.checked_trajectory.check_trajectory", again)
    stepped.session.play(checked)
    stepped.until_idle()
    assert stepped.told(PlaybackFinished)[0].completed
    with pytest.raises(AssertionError, match="checked again"):
        stepped.session.play(there_and_back())


def test_a_record_is_checked_once(stepped, monkeypatch):
    calls = []
    checking = checked_module.check_trajectory
    monkeypatch.setattr(
        checked_module,
        "check_trajectory",
        lambda *args, **more: calls.append(args) or checking(*args, **more),
    )
    stepped.session.play(there_and_back())
    stepped.until_idle()
    assert stepped.told(PlaybackFinished)[0].completed
    assert len(calls) == 1


def test_a_session_tells_the_set_point_period_of_its_device(make_stepped):
    assert make_stepped(settings={"sample_rate_hz": 500.0}).session.setpoint_period_s == 2e-3
    assert make_stepped("picma", driver=Faulty).session.setpoint_period_s == 1e-3


@pytest.mark.parametrize("hook", ["read", "move_to"])
@pytest.mark.parametrize(
    "error",
    [ConnectionLostError("cable pulled"), DriverTimeoutError("no answer"), RuntimeError("bug")],
)
def test_a_failing_driver_locks_motion_until_reconnected(stepped, hook, error):
    stepped.session.go_to({"x": 0.03})
    stepped.driver.before[hook] = raising(error)
    state = stepped.step()
    assert state.connection is Connection.FAILED
    assert state.activity is DeviceState.CLOSED
    assert not state.position_known
    assert str(error) in state.fault
    assert "x" in state.measured
    (fault,) = stepped.told(Faulted)
    assert str(error) in fault.message
    assert stepped.driver.status().state is DeviceState.CLOSED
    stepped.driver.before.clear()
    assert stepped.step(0.1, 10).connection is Connection.FAILED
    for request in (lambda: stepped.session.jog("x", 1e-4), stepped.session.service.clear_fault):
        with pytest.raises(RefusedError, match="reconnect"):
            request()
    stepped.session.reconnect()
    state = stepped.step()
    assert state.connection is Connection.CONNECTED
    assert state.fault is None
    with pytest.raises(RefusedError, match="home, or confirm it"):
        stepped.session.jog("x", 1e-4)
    stepped.session.confirm_position()
    stepped.step()
    stepped.session.jog("x", 1e-4)
    stepped.until_idle()
    with pytest.raises(RefusedError, match="is connected"):
        stepped.session.reconnect()


def test_a_failure_ends_a_playback_with_what_was_recorded(stepped):
    stepped.session.play(there_and_back())
    stepped.step(0.05, 30)
    stepped.driver.before["read"] = raising(ConnectionLostError("cable pulled"))
    stepped.step()
    (finished,) = stepped.told(PlaybackFinished)
    assert not finished.completed
    assert len(finished.record.time_s) > 100


def test_a_device_that_cannot_be_reached_fails_and_may_be_tried_again(make_stepped):
    made = make_stepped(connect=False)
    made.driver.before["open"] = raising(ConnectionLostError("no such port"))
    made.connect()
    assert made.session.snapshot().connection is Connection.FAILED
    made.driver.before.clear()
    made.session.reconnect()
    assert made.step().connection is Connection.CONNECTED


def test_a_refusal_of_the_device_is_told_and_changes_nothing(stepped):
    stepped.driver.before["move_to"] = raising(StateError("door open"))
    stepped.session.go_to({"x": 0.03})
    state = stepped.step()
    assert [event.message for event in stepped.told(CommandRefused)] == ["door open"]
    assert state.connection is Connection.CONNECTED
    assert state.locked is None
    stepped.driver.before.clear()
    stepped.session.jog("x", 1e-4)
    assert stepped.until_idle().command["x"] == 0.0275 + 1e-4


def test_a_refusal_of_one_axis_leaves_the_targets_of_all_alone(stepped):
    stepped.session.go_to({"x": 0.05, "y": 0.03})
    stepped.step(0.1, 2)
    stepped.driver.before["move_to"] = raising(StateError("door open"))
    stepped.session.go_to({"x": 0.04})
    stepped.step()
    assert len(stepped.told(CommandRefused)) == 1
    stepped.driver.before.clear()
    stepped.session.jog("x", 1e-3)
    stepped.session.jog("y", 1e-3)
    state = stepped.until_idle()
    assert state.command["x"] == pytest.approx(0.051, abs=1e-15)
    assert state.command["y"] == pytest.approx(0.031, abs=1e-15)


def test_a_jog_from_within_a_command_counts_from_that_command(stepped):
    """Another thread jogs in the very moment in which a move is handed over."""

    def jog_once():
        stepped.driver.before.clear()
        stepped.session.jog("x", 1e-3)

    stepped.driver.before["move_to"] = jog_once
    stepped.session.go_to({"x": 0.03})
    assert stepped.until_idle().command["x"] == pytest.approx(0.031, abs=1e-15)


def test_a_silent_device_locks_motion(stepped):
    stepped.clock.advance(3.0)
    state = stepped.session.snapshot()
    assert state.age_s == pytest.approx(3.0)
    assert "nothing for 3.0 s" in state.locked
    with pytest.raises(RefusedError, match="locked"):
        stepped.session.jog("x", 1e-4)
    stepped.session.run_once()
    assert stepped.session.snapshot().locked is None


class Faulty(Driver):
    """A device with one axis that reports a fault, or does not know where it is."""

    name = "faulty"

    def __init__(self, robot, settings=None, *, clock):
        super().__init__(robot, settings, clock=clock)
        self.answer = DeviceStatus(DeviceState.IDLE)

    def _open(self):
        self._ticks = 0

    def _close(self):
        pass

    def _status(self):
        return self.answer

    def _move_to(self, targets, speeds, permit):
        pass

    def _stop(self):
        pass

    def _clear_fault(self, permit):
        self.answer = DeviceStatus(DeviceState.IDLE)

    def _read(self):
        self._ticks += 1
        zero = np.zeros((1, len(self.axes)))
        return Samples(np.array([self._ticks * 0.01]), zero, zero, zero, np.array([-1]))


def test_a_device_fault_locks_until_it_is_cleared(make_stepped):
    made = make_stepped("picma", driver=Faulty)
    made.driver.answer = DeviceStatus(DeviceState.FAULT, fault="over-temperature")
    state = made.step(times=3)
    assert state.connection is Connection.CONNECTED
    assert "over-temperature" in state.locked
    assert [event.message for event in made.told(Faulted)] == ["over-temperature"]
    with pytest.raises(RefusedError, match="over-temperature"):
        made.session.jog("p", 1e-6)
    made.driver.answer = DeviceStatus(DeviceState.IDLE)
    assert "over-temperature" in made.step().locked
    made.driver.answer = DeviceStatus(DeviceState.FAULT, fault="over-temperature")
    made.session.service.clear_fault()
    assert made.step().locked is None


def test_an_unknown_position_locks_motion(make_stepped):
    made = make_stepped("picma", driver=Faulty)
    made.driver.answer = DeviceStatus(DeviceState.IDLE, position_known=False)
    assert not made.step().position_known
    with pytest.raises(RefusedError, match="position is not known"):
        made.session.go_to({"p": 1e-6})


def test_a_driver_that_cannot_play_is_not_asked_to(make_stepped):
    made = make_stepped("picma", driver=Faulty)
    with pytest.raises(RefusedError, match="cannot play"):
        made.session.play(there_and_back("p", 1e-6, 1e-7))


def test_a_trajectory_for_another_robot_is_refused(stepped):
    with pytest.raises(TrajectoryError, match="elbow"):
        stepped.session.play(there_and_back("elbow"))


def test_a_subscriber_that_fails_is_logged_and_the_rest_goes_on(stepped, caplog):
    stepped.session.subscribe(lambda event: 1 / 0)
    later = []
    end = stepped.session.subscribe(later.append)
    stepped.session.jog("x", 1e-4)
    stepped.step()
    assert "ZeroDivisionError" in caplog.text
    assert len(later) == 1
    end()
    end()
    stepped.until_idle()
    assert len(later) == 1


def test_a_subscriber_may_answer_the_end_of_a_playback_with_the_next(stepped):
    runs = []

    def play_again(event):
        if isinstance(event, PlaybackFinished):
            runs.append(event.completed)
            if len(runs) < 2:
                stepped.session.play(there_and_back())

    stepped.session.subscribe(play_again)
    stepped.session.play(there_and_back())
    for _ in range(400):
        stepped.step(0.02)
    assert runs == [True, True]


def test_closing_ends_a_playback_and_may_be_repeated(stepped):
    stepped.session.play(there_and_back())
    stepped.step(0.05, 30)
    assert stepped.session.close()
    assert stepped.session.close()
    assert not stepped.told(PlaybackFinished)[0].completed
    assert stepped.session.snapshot().connection is Connection.DISCONNECTED
    assert stepped.driver.status().state is DeviceState.CLOSED


def test_a_session_on_its_own_thread(make_stepped):
    """The one test with a real thread and clock; every wait is for an event."""
    from rotemina.app.motion.session import MotionSession
    from rotemina.drivers.simulator.driver import Simulator

    session = MotionSession(Simulator(load_robot("rotemina"), {"settle_s": 0.01}))
    seen = {"connected": threading.Event(), "moving": threading.Event(), "idle": threading.Event()}
    finished, workers = [], set()
    ended = threading.Event()

    def watch(event):
        workers.add(threading.current_thread().name)
        if isinstance(event, StateChanged):
            if event.state.locked is None:
                seen["connected"].set()
            if event.state.activity.value in seen:
                seen[event.state.activity.value].set()
        if isinstance(event, PlaybackFinished):
            finished.append(event)
            ended.set()

    session.subscribe(watch)
    session.start()
    with pytest.raises(RefusedError, match="already been started"):
        session.start()
    try:
        assert seen["connected"].wait(20)
        session.go_to({"x": 0.05})
        assert seen["moving"].wait(20)
        seen["idle"].clear()
        session.stop()
        assert seen["idle"].wait(20)
        state = session.snapshot()
        assert state.command["x"] < 0.05
        assert 0.0 <= state.stop_latency_s <= state.standstill_s
        session.play(there_and_back(start=state.command["x"], distance=1e-4))
        assert ended.wait(20)
        assert finished[0].completed
    finally:
        assert session.close()
    assert workers == {"motion session"}
    assert len(session.history.tail(0.2)) > 100
    assert "motion session" not in {thread.name for thread in threading.enumerate()}


def test_a_stop_says_who_asked_for_it_why_and_when(make_stepped):
    stepped = make_stepped(local_time=lambda: NOON)
    session = stepped.session
    assert session.snapshot().stop is None
    session.stop(by=OPERATOR)
    assert session.snapshot().stop == StopRequest("operator", "", NOON)
    session.stop("the window does not respond")
    session.emergency_stop(by=OPERATOR)
    stepped.step()
    assert [str(event.request) for event in stepped.told(Stopped)] == [
        "Stopped by the operator at 12:00:00",
        "Stopped by the program at 12:00:00: the window does not respond",
        "Stopped by the operator at 12:00:00: stop and lock",
    ]


def test_a_stop_is_told_of_also_where_the_device_fails(stepped):
    stepped.driver.before["read"] = raising(ConnectionLostError("cable pulled"))
    stepped.step()
    stepped.session.stop(by=OPERATOR)
    stepped.step()
    assert len(stepped.told(Stopped)) == 1


def test_numbers_that_are_none_are_refused_and_the_connection_lives(stepped):
    for at, speeds in (("0.03", {}), (0.03, {"x": "0.01"}), (0.03, {"q": 1.0})):
        with pytest.raises(OutOfLimitsError):
            stepped.session.go_to({"x": at}, speeds=speeds)
    stepped.step()
    assert stepped.session.snapshot().connection is Connection.CONNECTED


def test_a_stop_is_the_last_event_only_until_anything_moves_or_is_accepted(stepped):
    session = stepped.session
    stepped.step()
    assert not session.snapshot().halted
    for operate in (
        lambda: session.jog("x", 1e-4),
        session.release,
        session.dismiss_stop,
        lambda: stepped.driver.move_to({"x": 0.03}, permit=session.permit()),  # by its own buttons
    ):
        session.go_to({"x": 0.02}, speeds={"x": 1e-3})
        stepped.step()
        session.stop()
        assert session.snapshot().halted
        stepped.until_idle()
        stepped.step(0.02, 5)
        assert session.snapshot().halted
        operate()
        stepped.step()
        assert not session.snapshot().halted
        stepped.until_idle()
        assert not session.snapshot().halted


def test_a_stop_that_overtakes_a_request_stays_the_last_event(stepped):
    session = stepped.session
    stepped.step()
    permit = session.permit()
    session.stop()
    with pytest.raises(RefusedError):
        session.go_to({"x": 0.02}, permit=permit)
    stepped.step()
    assert session.snapshot().halted


def test_a_lost_link_is_told_from_a_device_that_failed(make_stepped):
    for error, lost in (
        (ConnectionError("unplugged"), True),
        (DeviceResetError("the board began again"), False),
        (ValueError("a bug"), False),
    ):
        stepped = make_stepped()

        def fail(error=error):
            raise error

        stepped.driver.before["read"] = fail
        assert stepped.step().link_lost is lost
    never = make_stepped(connect=False)

    def refuse():
        raise ConnectionError("no such port")

    never.driver.before["open"] = refuse
    assert never.connect().step().link_lost is False


def test_the_silence_of_a_device_that_sends_nothing_more_is_measured(stepped):
    stepped.step()
    stepped.clock.advance(3.0)  # and the worker hangs in the driver
    state = stepped.session.snapshot()
    assert state.silent_s == pytest.approx(3.0, abs=0.1)
    assert state.phase is Phase.SHORT_LOSS
