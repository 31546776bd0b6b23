"""Manual playback: pace, pauses, steps, and a stop at a deviation from the model."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.playback import Playback, PlaybackPhase
from rotemina.app.motion.state import PlaybackFinished
from rotemina.drivers.contract import DeviceState
from rotemina.sim.errors import InputError, OutOfLimitsError
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.trajectory.checked_trajectory import check_and_seal

PERIOD_S = 1e-3
ROWS = 2001


def make_swing(robot, amplitude=1e-3, axis="x", start=0.02):
    time_s = np.arange(ROWS) * PERIOD_S
    path = start + amplitude * np.sin(np.pi * time_s / 2.0) ** 4
    trajectory = Record.from_signals(time_s, {(axis, Tap.CMD): path}, {axis: "m"})
    return check_and_seal(robot, trajectory, PERIOD_S)


@pytest.fixture
def harness(make_harness):
    return make_harness(settings={"settle_s": 0.1})


@pytest.fixture
def messages():
    return []


@pytest.fixture
def playback(harness, messages):
    playback = Playback(harness.session, messages.append)
    yield playback
    playback.close()


def step_until_row(harness, playback, row):
    for _ in range(2000):
        harness.step(0.005)
        if playback.state.row >= row:
            return
    raise AssertionError(playback.state)


def pause_at_row(harness, playback, row):
    """Play a swing of x and pause at about a row; return the trajectory."""
    trajectory = make_swing(harness.session.robot)
    playback.play(trajectory)
    step_until_row(harness, playback, row)
    playback.pause()
    harness.step_until_idle()
    return trajectory


def finish(harness, playback):
    """Step until the playback has ended at its last row."""
    harness.step_until_idle()
    assert (playback.state.phase, playback.state.row) == (PlaybackPhase.IDLE, ROWS - 1)


def list_records(harness):
    return [event.record for event in harness.list_events(PlaybackFinished)]


def test_a_playback_ends_at_its_last_row_and_the_next_one_has_its_own_pace(harness, playback):
    trajectory = make_swing(harness.session.robot)
    playback.play(trajectory)
    assert playback.state.phase is PlaybackPhase.PLAYING
    finish(harness, playback)
    state = playback.state
    assert (state.rows, state.path_s) == (ROWS, pytest.approx(2.0, abs=1e-6))
    assert 0.0 < state.gaps["x"].rms <= state.gaps["x"].peak < 1e-6
    (record,) = list_records(harness)
    command = trajectory.commands.signal("x", Tap.CMD)
    np.testing.assert_allclose(record.signal("x", Tap.CMD), command, atol=1e-12)
    playback.play(trajectory, speed=0.5)
    assert playback.state.path_s == 0.0  # not the end of the first playback
    finish(harness, playback)
    assert list_records(harness)[1].duration_s == pytest.approx(4.0, abs=2e-3)


def test_a_pace_beyond_the_limits_is_refused_and_nothing_moves(harness, playback):
    with pytest.raises(InputError, match=r"axis x|x:"):
        playback.play(make_swing(harness.session.robot, 8e-3), speed=10.0)
    assert playback.state.phase is PlaybackPhase.IDLE
    harness.step()
    assert harness.session.snapshot().activity is DeviceState.IDLE


def test_a_paused_and_resumed_playback_passes_every_row(harness, playback):
    trajectory = pause_at_row(harness, playback, 700)
    paused_state = playback.state
    assert paused_state.phase is PlaybackPhase.PAUSED
    assert 700 <= paused_state.row < 720
    paused_x = harness.session.snapshot().command["x"]
    harness.step(0.02, 20)
    assert harness.session.snapshot().command["x"] == paused_x  # it does not continue by itself
    playback.resume()
    with pytest.raises(RequestRefusedError, match="nothing is paused"):
        playback.resume()
    finish(harness, playback)
    first, second = list_records(harness)
    command = trajectory.commands.signal("x", Tap.CMD)
    played = first.signal("x", Tap.CMD)
    np.testing.assert_allclose(played, command[: len(played)], atol=1e-12)
    assert second.signal("x", Tap.CMD)[0] == pytest.approx(command[paused_state.row], abs=1e-12)
    assert second.signal("x", Tap.CMD)[-1] == pytest.approx(command[-1], abs=1e-12)


def test_after_a_pause_before_the_first_row_it_begins_at_the_first_row(harness, playback):
    playback.play(make_swing(harness.session.robot))
    harness.step(0.02)
    playback.pause()
    harness.step_until_idle()
    assert playback.state.phase is PlaybackPhase.PAUSED
    assert playback.state.row == -1
    playback.resume()
    finish(harness, playback)
    assert len(list_records(harness)[-1].time_s) >= ROWS


def test_steps_go_to_rows_and_back(harness, playback):
    trajectory = make_swing(harness.session.robot)
    playback.load_paused(trajectory)
    command = trajectory.commands.signal("x", Tap.CMD)
    for rows, row in ((1, 0), (500, 500), (-200, 300), (1700, 2000)):
        playback.step(rows)
        harness.step_until_idle()
        assert playback.state.row == row
        assert harness.session.snapshot().command["x"] == pytest.approx(command[row], abs=1e-12)
    with pytest.raises(RequestRefusedError, match="rows 0 to 2000"):
        playback.step(1)


def test_a_playback_can_be_resumed_after_a_step(harness, playback):
    playback.load_paused(make_swing(harness.session.robot))
    playback.step(1001)
    harness.step_until_idle()
    playback.resume(speed=2.0)
    finish(harness, playback)
    assert list_records(harness)[0].duration_s == pytest.approx(0.5 + 0.25, abs=0.01)


def test_a_deviation_from_the_model_stops_the_motion(harness, playback, messages):
    effect = AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.2})
    harness.session.service.set_effects((effect,))
    harness.step()
    trajectory = make_swing(harness.session.robot, 20e-6, axis="zn", start=30e-6)
    playback.play(trajectory, bounds={"zn": 8e-6})
    harness.step_until_idle()
    assert [message.startswith("axis zn deviates") for message in messages] == [True]
    state = playback.state
    assert state.excess == messages[0]
    assert state.phase is PlaybackPhase.PAUSED
    assert 0 < state.row < ROWS // 2
    assert list_records(harness)[0] is not None  # the played part is kept


def test_a_stop_ends_a_playback_but_only_blocks_a_pause(harness, playback):
    playback.play(make_swing(harness.session.robot))
    step_until_row(harness, playback, 100)
    harness.session.stop()
    harness.step_until_idle()
    assert playback.state.phase is PlaybackPhase.IDLE
    for request in (playback.pause, playback.resume, playback.step):
        with pytest.raises(RequestRefusedError, match="nothing"):
            request()
    pause_at_row(harness, playback, 100)
    harness.session.emergency_stop()
    for request in (playback.resume, playback.step):
        with pytest.raises(RequestRefusedError, match="release it first"):
            request()
    harness.session.release()
    playback.resume()
    finish(harness, playback)


def test_a_lost_device_ends_a_pause(harness, playback):
    pause_at_row(harness, playback, 100)
    harness.driver.fail("read", ConnectionError("unplugged"))
    harness.step()
    assert playback.state.phase is PlaybackPhase.IDLE


def test_two_playbacks_at_once_are_refused(harness, playback):
    trajectory = make_swing(harness.session.robot)
    playback.play(trajectory)
    harness.step()
    with pytest.raises(RequestRefusedError, match="playing"):
        playback.play(trajectory)
    with pytest.raises(RequestRefusedError, match="playing"):
        playback.load_paused(trajectory)
    finish(harness, playback)


def test_a_path_into_the_floor_is_refused(harness, playback):
    robot = harness.session.robot
    time_s = np.arange(3001) * PERIOD_S
    height = 0.04 - 0.002 * np.sin(np.pi * time_s / 6.0) ** 2
    dive = check_and_seal(
        robot, Record.from_signals(time_s, {("z", Tap.CMD): height}, {"z": "m"}), PERIOD_S
    )
    harness.session.bounds.teach_floor(0.0005)
    with pytest.raises(OutOfLimitsError):
        playback.play(dive)
    assert playback.state.phase is PlaybackPhase.IDLE


@pytest.fixture
def session_without_speed_limit(make_harness):
    robot = load_robot("rotemina")
    axis_without_limit = replace(robot.axes["x"], max_speed=None)
    return make_harness(
        replace(robot, axes={**robot.axes, "x": axis_without_limit}), settings={"settle_s": 0.1}
    )


def test_the_speed_limit_of_a_trajectory_applies_at_any_pace(session_without_speed_limit):
    playback = Playback(session_without_speed_limit.session)
    trajectory = make_swing(session_without_speed_limit.session.robot)  # up to 2.04 mm/s
    assert playback.axes_without_speed_limit(trajectory) == ("x",)
    playback.limit_speeds(trajectory, {"x": 2.1e-3})
    assert playback.axes_without_speed_limit(trajectory) == ()
    with pytest.raises(OutOfLimitsError, match=r"axis x: speed .* at row .* limit 2\.1 mm/s"):
        playback.play(trajectory, speed=1.5)
    assert playback.state.phase is PlaybackPhase.IDLE
    playback.play(trajectory)
    step_until_row(session_without_speed_limit, playback, 100)
    playback.pause()
    session_without_speed_limit.step_until_idle()
    with pytest.raises(OutOfLimitsError, match=r"limit 2\.1 mm/s"):
        playback.resume(speed=1.5)
    playback.resume()
    session_without_speed_limit.step_until_idle()
    assert playback.state.row == ROWS - 1
    playback.close()


@pytest.mark.parametrize("speeds", [{"x": 0.0}, {"x": float("nan")}, {"y": 1e-3}])
def test_an_invalid_speed_limit_is_refused(harness, playback, speeds):
    with pytest.raises(OutOfLimitsError, match="must be a finite number above 0"):
        playback.limit_speeds(make_swing(harness.session.robot), speeds)


@pytest.fixture
def paused_swing(harness, playback):
    """Pause a swing of x at about row 700, and return the trajectory."""
    trajectory = pause_at_row(harness, playback, 700)
    harness.step(0.02, 3)
    return trajectory


def test_axes_moved_during_a_pause_are_reported_with_their_distance(
    harness, playback, paused_swing
):
    assert playback.state.moved == {}
    session = harness.session
    session.jog("y", 2.7e-3)
    assert playback.state.moved == {}  # not before the axis is at rest
    harness.step_until_idle()
    assert playback.state.moved == {"y": pytest.approx(2.7e-3)}
    for request in (playback.resume, playback.step):
        with pytest.raises(
            RequestRefusedError, match=r"axis y moved 2\.7 mm since the pause; move it"
        ):
            request()
    assert playback.state.phase is PlaybackPhase.PAUSED
    session.stop()  # another stop does not change the position of the pause
    harness.step(0.02, 5)
    assert playback.state.moved == {"y": pytest.approx(2.7e-3)}
    session.jog("y", -2.7e-3)
    harness.step_until_idle()
    assert playback.state.moved == {}
    playback.resume()
    finish(harness, playback)


def test_a_distance_below_the_sensor_noise_is_no_motion(harness, playback, paused_swing):
    harness.session.jog("x", 0.1e-6)  # its sensor has a resolution of 0.1 µm
    harness.step_until_idle()
    assert playback.state.moved == {}
    harness.session.jog("x", 0.2e-6)
    harness.step_until_idle()
    assert playback.state.moved == {"x": pytest.approx(0.3e-6)}


def test_axes_move_back_slowly_before_it_resumes(harness, playback, paused_swing):
    session = harness.session
    row = playback.state.row
    session.go_to({"x": 0.03, "y": 0.03})
    harness.step_until_idle()
    began_s = harness.clock()
    playback.move_back()
    speeds, previous = [], session.snapshot().command
    while not session.at_rest:
        command = harness.step(0.02).command
        speeds += [abs(command[axis] - previous[axis]) / 0.02 for axis in "xy"]
        previous = command
    assert 0.9e-3 < max(speeds) < 1.1e-3  # a tenth of 10 mm/s
    assert harness.clock() - began_s > 2.0
    expected = paused_swing.commands.signal("x", Tap.CMD)
    assert previous["x"] == pytest.approx(expected[row], abs=1e-9)
    assert playback.state.moved == {}
    assert playback.state.row == row
    playback.resume()
    finish(harness, playback)
    assert list_records(harness)[-1].signal("x", Tap.CMD)[0] == pytest.approx(
        expected[row], abs=1e-12
    )


def test_a_stopped_return_leaves_the_remaining_distance_and_the_swing_can_start_over(
    harness, playback, paused_swing
):
    session, permit = harness.session, harness.session.permit()
    session.jog("y", 2e-3)
    harness.step_until_idle()
    playback.move_back(permit=permit)
    harness.step(0.05, 20)
    session.stop()
    harness.step_until_idle()
    harness.step()
    assert 0.5e-3 < playback.state.moved["y"] < 1.5e-3
    for request in (playback.move_back, playback.resume):
        with pytest.raises(RequestRefusedError, match="Not resumed: the machine was stopped again"):
            request(permit=permit)
    playback.start_over(speed=2.0)
    finish(harness, playback)
    command = paused_swing.commands.signal("x", Tap.CMD)
    assert list_records(harness)[-1].signal("x", Tap.CMD)[0] == pytest.approx(command[0], abs=1e-12)


def test_a_playback_stopped_before_it_began_has_ended(harness, playback):
    playback.play(make_swing(harness.session.robot))
    harness.session.stop()  # the worker has not taken the request yet
    harness.step()
    assert playback.state.phase is PlaybackPhase.IDLE
    assert list_records(harness) == [None]


def test_a_resumption_stopped_before_it_began_is_still_paused(harness, playback, paused_swing):
    row = playback.state.row
    playback.resume()
    harness.session.stop()
    harness.step()
    assert (playback.state.phase, playback.state.row) == (PlaybackPhase.PAUSED, row)
    playback.resume()
    finish(harness, playback)


def test_a_deviation_counts_only_once_the_playback_has_begun(
    harness, playback, messages, monkeypatch
):
    effect = AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.2})
    harness.session.service.set_effects((effect,))
    harness.step()
    playback.play(
        make_swing(harness.session.robot, 20e-6, axis="zn", start=30e-6), bounds={"zn": 8e-6}
    )
    harness.step_until_idle()
    assert len(messages) == 1
    guard = harness.session.bounds._guard

    def check(*_):  # during the check the machine is at rest beyond the bound
        harness.step(0.02, 10)

    monkeypatch.setattr(guard, "check_trajectory", check)
    playback.resume()  # no stop of the playback has overtaken it
    assert len(messages) == 1
    harness.step_until_idle()
    state = playback.state
    assert (state.phase, state.excess, len(messages)) == (PlaybackPhase.PAUSED, messages[1], 2)
