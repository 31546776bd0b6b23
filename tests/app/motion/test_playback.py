"""Playback by hand: a pace, pauses, steps, and a stop where model and machine part."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.playback import Playback, PlaybackPhase
from rotemina.app.motion.state import PlaybackFinished
from rotemina.drivers.samples import DeviceState
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError
from rotemina.sim.trajectory.checked_trajectory import check

PERIOD_S = 1e-3
ROWS = 2001


def swing(robot, amplitude=1e-3, axis="x", start=0.02):
    time_s = np.arange(ROWS) * PERIOD_S
    path = start + amplitude * np.sin(np.pi * time_s / 2.0) ** 4
    trajectory = Record.from_signals(time_s, {(axis, Tap.CMD): path}, {axis: "m"})
    return check(robot, trajectory, PERIOD_S)


@pytest.fixture
def stepped(make_stepped):
    return make_stepped(settings={"settle_s": 0.1})


@pytest.fixture
def told():
    return []


@pytest.fixture
def playback(stepped, told):
    playback = Playback(stepped.session, told.append)
    yield playback
    playback.close()


def until_row(stepped, playback, row):
    for _ in range(2000):
        stepped.step(0.005)
        if playback.state.row >= row:
            return
    raise AssertionError(playback.state)


def records(stepped):
    return [event.record for event in stepped.told(PlaybackFinished)]


def test_a_playback_ends_at_its_last_row(stepped, playback):
    trajectory = swing(stepped.session.robot)
    playback.play(trajectory)
    assert playback.state.phase is PlaybackPhase.PLAYING
    stepped.until_idle()
    state = playback.state
    assert (state.phase, state.row, state.rows) == (PlaybackPhase.IDLE, ROWS - 1, ROWS)
    assert state.path_s == pytest.approx(2.0, abs=1e-6)
    assert 0.0 < state.gaps["x"].rms <= state.gaps["x"].peak < 1e-6
    (record,) = records(stepped)
    np.testing.assert_allclose(
        record.signal("x", Tap.CMD), trajectory.commands.signal("x", Tap.CMD), atol=1e-12
    )


def test_a_second_playback_begins_at_its_own_beginning(stepped, playback):
    playback.play(swing(stepped.session.robot))
    stepped.until_idle()
    playback.play(swing(stepped.session.robot))
    assert playback.state.path_s == 0.0  # not the end of the one before
    stepped.until_idle()
    assert playback.state.row == ROWS - 1


@pytest.mark.parametrize("speed", [0.5, 2.0])
def test_a_pace(stepped, playback, speed):
    playback.play(swing(stepped.session.robot), speed=speed)
    stepped.until_idle()
    assert playback.state.row == ROWS - 1
    assert records(stepped)[0].duration_s == pytest.approx(2.0 / speed, abs=2e-3)


def test_a_pace_beyond_the_limits_is_refused_and_nothing_moves(stepped, playback):
    with pytest.raises(InputError, match=r"axis x|x:"):
        playback.play(swing(stepped.session.robot, 8e-3), speed=10.0)
    assert playback.state.phase is PlaybackPhase.IDLE
    stepped.step()
    assert stepped.session.snapshot().activity is DeviceState.IDLE


def test_paused_and_gone_on_with_the_machine_passes_every_row(stepped, playback):
    trajectory = swing(stepped.session.robot)
    playback.play(trajectory)
    until_row(stepped, playback, 700)
    playback.pause()
    stepped.until_idle()
    paused = playback.state
    assert paused.phase is PlaybackPhase.PAUSED
    assert 700 <= paused.row < 720
    stood = stepped.session.snapshot().command["x"]
    stepped.step(0.02, 20)
    assert stepped.session.snapshot().command["x"] == stood  # it does not go on by itself
    playback.resume()
    stepped.until_idle()
    assert playback.state.phase is PlaybackPhase.IDLE
    assert playback.state.row == ROWS - 1
    first, second = records(stepped)
    wanted = trajectory.commands.signal("x", Tap.CMD)
    reached = first.signal("x", Tap.CMD)
    np.testing.assert_allclose(reached, wanted[: len(reached)], atol=1e-12)
    assert second.signal("x", Tap.CMD)[0] == pytest.approx(wanted[paused.row], abs=1e-12)
    assert second.signal("x", Tap.CMD)[-1] == pytest.approx(wanted[-1], abs=1e-12)


def test_a_pause_before_the_first_row_begins_at_the_first_row(stepped, playback):
    playback.play(swing(stepped.session.robot))
    stepped.step(0.02)
    playback.pause()
    stepped.until_idle()
    assert playback.state.phase is PlaybackPhase.PAUSED
    assert playback.state.row == -1
    playback.resume()
    stepped.until_idle()
    assert playback.state.row == ROWS - 1
    assert len(records(stepped)[-1].time_s) >= ROWS


def test_steps_go_to_rows_and_back(stepped, playback):
    trajectory = swing(stepped.session.robot)
    playback.load_paused(trajectory)
    wanted = trajectory.commands.signal("x", Tap.CMD)
    for rows, row in ((1, 0), (500, 500), (-200, 300), (1700, 2000)):
        playback.step(rows)
        stepped.until_idle()
        assert playback.state.row == row
        assert stepped.session.snapshot().command["x"] == pytest.approx(wanted[row], abs=1e-12)
    with pytest.raises(RefusedError, match="rows 0 to 2000"):
        playback.step(1)


def test_from_a_step_it_can_be_played_on(stepped, playback):
    playback.load_paused(swing(stepped.session.robot))
    playback.step(1001)
    stepped.until_idle()
    playback.resume(speed=2.0)
    stepped.until_idle()
    assert playback.state.row == ROWS - 1
    assert records(stepped)[0].duration_s == pytest.approx(0.5 + 0.25, abs=0.01)


def test_model_and_machine_parting_stops_the_motion(stepped, playback, told):
    effect = AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.2})
    stepped.session.service.set_effects((effect,))
    stepped.step()
    trajectory = swing(stepped.session.robot, 20e-6, axis="zn", start=30e-6)
    playback.play(trajectory, bounds={"zn": 8e-6})
    stepped.until_idle()
    assert [one.startswith("axis zn deviates") for one in told] == [True]
    state = playback.state
    assert state.excess == told[0]
    assert state.phase is PlaybackPhase.PAUSED
    assert 0 < state.row < ROWS // 2
    assert records(stepped)[0] is not None  # what was played is kept


def test_an_operator_s_stop_ends_it(stepped, playback):
    playback.play(swing(stepped.session.robot))
    until_row(stepped, playback, 100)
    stepped.session.stop()
    stepped.until_idle()
    assert playback.state.phase is PlaybackPhase.IDLE
    with pytest.raises(RefusedError, match="nothing is paused"):
        playback.resume()


def test_an_emergency_stop_in_a_pause_lets_nothing_go_on_until_released(stepped, playback):
    playback.play(swing(stepped.session.robot))
    until_row(stepped, playback, 100)
    playback.pause()
    stepped.until_idle()
    stepped.session.emergency_stop()
    with pytest.raises(RefusedError, match="release it first"):
        playback.resume()
    with pytest.raises(RefusedError, match="release it first"):
        playback.step()
    stepped.session.release()
    playback.resume()
    stepped.until_idle()
    assert playback.state.row == ROWS - 1


def test_a_lost_device_ends_a_pause(stepped, playback):
    playback.play(swing(stepped.session.robot))
    until_row(stepped, playback, 100)
    playback.pause()
    stepped.until_idle()

    def gone():
        raise ConnectionError("unplugged")

    stepped.driver.before["read"] = gone
    stepped.step()
    assert playback.state.phase is PlaybackPhase.IDLE


def test_nothing_to_pause_or_step_is_refused(playback):
    for request in (playback.pause, playback.resume, playback.step):
        with pytest.raises(RefusedError, match="nothing"):
            request()


def test_two_at_once_are_refused(stepped, playback):
    trajectory = swing(stepped.session.robot)
    playback.play(trajectory)
    stepped.step()
    with pytest.raises(RefusedError, match="playing"):
        playback.play(trajectory)
    with pytest.raises(RefusedError, match="playing"):
        playback.load_paused(trajectory)
    stepped.until_idle()
    assert playback.state.row == ROWS - 1


def test_a_path_into_the_floor_is_refused_as_in_any_playback(stepped, playback):
    robot = stepped.session.robot
    time_s = np.arange(3001) * PERIOD_S
    down = 0.04 - 0.002 * np.sin(np.pi * time_s / 6.0) ** 2
    dive = check(robot, Record.from_signals(time_s, {("z", Tap.CMD): down}, {"z": "m"}), PERIOD_S)
    stepped.session.bounds.teach_floor(0.0005)
    with pytest.raises(OutOfLimitsError):
        playback.play(dive)
    assert playback.state.phase is PlaybackPhase.IDLE


@pytest.fixture
def unlimited(make_stepped):
    robot = load_robot("rotemina")
    free = replace(robot.axes["x"], max_speed=None)
    return make_stepped(replace(robot, axes={**robot.axes, "x": free}), settings={"settle_s": 0.1})


def test_a_trajectory_keeps_the_speed_limit_that_it_was_given_at_any_pace(unlimited):
    playback = Playback(unlimited.session)
    trajectory = swing(unlimited.session.robot)  # up to 2.04 mm/s
    assert playback.axes_without_speed_limit(trajectory) == ("x",)
    playback.limit_speeds(trajectory, {"x": 2.1e-3})
    assert playback.axes_without_speed_limit(trajectory) == ()
    with pytest.raises(OutOfLimitsError, match=r"axis x: speed .* at row .* limit 2\.1 mm/s"):
        playback.play(trajectory, speed=1.5)
    assert playback.state.phase is PlaybackPhase.IDLE
    playback.play(trajectory)
    until_row(unlimited, playback, 100)
    playback.pause()
    unlimited.until_idle()
    with pytest.raises(OutOfLimitsError, match=r"limit 2\.1 mm/s"):
        playback.resume(speed=1.5)
    playback.resume()
    unlimited.until_idle()
    assert playback.state.row == ROWS - 1
    playback.close()


@pytest.mark.parametrize("speeds", [{"x": 0.0}, {"x": float("nan")}, {"y": 1e-3}])
def test_a_speed_limit_that_is_none_is_refused(stepped, playback, speeds):
    with pytest.raises(OutOfLimitsError, match="must be a finite number above 0"):
        playback.limit_speeds(swing(stepped.session.robot), speeds)


# --- moved during a pause -------------------------------------------------------------------------


@pytest.fixture
def paused(stepped, playback):
    """Pause a swing of x at about row 700, and return the trajectory."""
    trajectory = swing(stepped.session.robot)
    playback.play(trajectory)
    until_row(stepped, playback, 700)
    playback.pause()
    stepped.until_idle()
    stepped.step(0.02, 3)
    return trajectory


def test_axes_that_were_moved_in_a_pause_are_named_with_their_distance(stepped, playback, paused):
    assert playback.state.moved == {}
    session = stepped.session
    session.jog("y", 2.7e-3)
    assert playback.state.moved == {}  # not before it rests
    stepped.until_idle()
    assert playback.state.moved == {"y": pytest.approx(2.7e-3)}
    for request in (playback.resume, playback.step):
        with pytest.raises(RefusedError, match=r"axis y moved 2\.7 mm since the pause; move it"):
            request()
    assert playback.state.phase is PlaybackPhase.PAUSED
    session.stop()  # another stop makes no other place of the pause
    stepped.step(0.02, 5)
    assert playback.state.moved == {"y": pytest.approx(2.7e-3)}
    session.jog("y", -2.7e-3)
    stepped.until_idle()
    assert playback.state.moved == {}
    playback.resume()
    stepped.until_idle()
    assert playback.state.row == ROWS - 1


def test_less_than_the_noise_of_a_sensor_is_no_motion(stepped, playback, paused):
    stepped.session.jog("x", 0.1e-6)  # its sensor has steps of 0.1 µm
    stepped.until_idle()
    assert playback.state.moved == {}
    stepped.session.jog("x", 0.2e-6)
    stepped.until_idle()
    assert playback.state.moved == {"x": pytest.approx(0.3e-6)}


def test_axes_move_back_slowly_and_then_it_resumes(stepped, playback, paused):
    session = stepped.session
    row = playback.state.row
    session.go_to({"x": 0.03, "y": 0.03})
    stepped.until_idle()
    began = stepped.clock()
    playback.move_back()
    speeds, before = [], session.snapshot().command
    while not session.at_rest:
        after = stepped.step(0.02).command
        speeds += [abs(after[axis] - before[axis]) / 0.02 for axis in "xy"]
        before = after
    assert 0.9e-3 < max(speeds) < 1.1e-3  # a tenth of 10 mm/s
    assert stepped.clock() - began > 2.0
    wanted = paused.commands.signal("x", Tap.CMD)
    assert before["x"] == pytest.approx(wanted[row], abs=1e-9)
    assert playback.state.moved == {}
    assert playback.state.row == row
    playback.resume()
    stepped.until_idle()
    assert playback.state.row == ROWS - 1
    assert records(stepped)[-1].signal("x", Tap.CMD)[0] == pytest.approx(wanted[row], abs=1e-12)


def test_a_way_back_that_was_stopped_halfway_leaves_the_rest_of_it(stepped, playback, paused):
    session, permit = stepped.session, stepped.session.permit()
    session.jog("y", 2e-3)
    stepped.until_idle()
    playback.move_back(permit=permit)
    stepped.step(0.05, 20)
    session.stop()
    stepped.until_idle()
    stepped.step()
    assert 0.5e-3 < playback.state.moved["y"] < 1.5e-3
    for request in (playback.move_back, playback.resume):
        with pytest.raises(RefusedError, match="Not resumed: the machine was stopped again"):
            request(permit=permit)


def test_it_starts_over_at_the_first_row_with_its_bounds(stepped, playback, paused):
    stepped.session.jog("y", 2e-3)
    stepped.until_idle()
    playback.start_over(speed=2.0)
    stepped.until_idle()
    assert playback.state.row == ROWS - 1
    wanted = paused.commands.signal("x", Tap.CMD)
    assert records(stepped)[-1].signal("x", Tap.CMD)[0] == pytest.approx(wanted[0], abs=1e-12)


def test_a_second_resume_is_refused(stepped, playback, paused):
    playback.resume()
    with pytest.raises(RefusedError, match="nothing is paused"):
        playback.resume()
    stepped.until_idle()
    assert playback.state.row == ROWS - 1


def test_a_playback_that_was_stopped_before_it_began_has_ended(stepped, playback):
    playback.play(swing(stepped.session.robot))
    stepped.session.stop()  # the worker has not taken it yet
    stepped.step()
    assert playback.state.phase is PlaybackPhase.IDLE
    assert records(stepped) == [None]


def test_a_resumption_that_was_stopped_before_it_began_is_still_paused(stepped, playback, paused):
    row = playback.state.row
    playback.resume()
    stepped.session.stop()
    stepped.step()
    assert (playback.state.phase, playback.state.row) == (PlaybackPhase.PAUSED, row)
    playback.resume()
    stepped.until_idle()
    assert playback.state.row == ROWS - 1


def test_a_deviation_counts_only_once_the_playback_has_begun(stepped, playback, told, monkeypatch):
    effect = AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.2})
    stepped.session.service.set_effects((effect,))
    stepped.step()
    playback.play(swing(stepped.session.robot, 20e-6, axis="zn", start=30e-6), bounds={"zn": 8e-6})
    stepped.until_idle()
    assert len(told) == 1
    guard = stepped.session.bounds._guard

    def check(*_):  # the path is being checked, and the machine is at rest beyond the bound
        stepped.step(0.02, 10)

    monkeypatch.setattr(guard, "play", check)
    playback.resume()  # which no stop of its own has overtaken
    assert len(told) == 1
    stepped.until_idle()
    state = playback.state
    assert (state.phase, state.excess, len(told)) == (PlaybackPhase.PAUSED, told[1], 2)
