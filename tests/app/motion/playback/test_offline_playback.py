"""Offline playback gives the record of a live playback."""

import numpy as np
import pytest

from rotemina.app.motion.playback import play_offline
from rotemina.app.motion.state import PlaybackFinished
from rotemina.drivers.contract import LimitError
from rotemina.drivers.simulator import Simulator
from rotemina.sim.errors import InputError
from rotemina.sim.plant import simulate_nominal_response
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot
from rotemina.sim.trajectory import dry_run

ROBOT = load_robot("rotemina")


def make_tilt(amplitude=1e-5):
    time_s = np.arange(1001) / 2000.0
    command = 5e-4 + amplitude * (1 - np.cos(2 * np.pi * 4 * time_s))
    return Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})


def test_the_record_is_the_trajectory_with_measurements():
    record = play_offline(ROBOT, make_tilt(), seed=2)
    np.testing.assert_array_equal(record.time_s, make_tilt().time_s)
    np.testing.assert_array_equal(record.signal("thx", Tap.CMD), make_tilt().signal("thx", Tap.CMD))
    modelled = simulate_nominal_response(ROBOT, make_tilt()).signal("thx", Tap.MEAS)
    deviation = record.signal("thx", Tap.MEAS) - modelled
    assert deviation.std() == pytest.approx(ROBOT.axes["thx"].sensor.noise_floor, rel=0.1)


def test_it_equals_the_record_of_a_live_playback_with_the_same_seed(make_harness):
    live = make_harness(driver=Simulator, settings={"seed": 2})
    live.step(0.3)
    live.session.play(make_tilt())
    live.step_until_idle()
    live_record = live.list_events(PlaybackFinished)[0].record
    for trajectory in (make_tilt(), dry_run(ROBOT, make_tilt()).require()):
        offline_record = play_offline(ROBOT, trajectory, seed=2)
        np.testing.assert_array_equal(live_record.values, offline_record.values)


def test_progress_rises_to_one():
    progress_values = []
    trajectory = Record.from_signals(np.arange(5.0), {("x", Tap.CMD): np.full(5, 0.02)}, {"x": "m"})
    play_offline(ROBOT, trajectory, progress=progress_values.append)
    assert progress_values == sorted(progress_values)
    assert progress_values[0] == 0.0
    assert progress_values[-1] == 1.0


def test_a_trajectory_beyond_a_limit_is_refused():
    with pytest.raises(LimitError, match="axis thx"):
        play_offline(ROBOT, make_tilt(amplitude=4e-4))


def test_in_closed_loop_the_record_of_sparse_rows_equals_the_model():
    """The loop runs at the ticks of the device, which are the rows of the record."""
    emps = load_robot("emps")
    command = 0.06 + 1e-3 * np.arange(7)
    trajectory = Record.from_signals(np.arange(7) * 0.5, {("q", Tap.CMD): command}, {"q": "m"})
    record = play_offline(emps, trajectory)
    assert record.closed_loop
    np.testing.assert_array_equal(record.time_s, np.arange(3001) / 1000)
    modelled = simulate_nominal_response(emps, record)
    # From 0.5 s on, because the model begins at the command, the device at its force balance.
    for tap, rounding in ((Tap.MEAS, 1e-12), (Tap.U, 1e-7)):
        deviation = record.signal("q", tap) - modelled.signal("q", tap)
        assert np.abs(deviation[500:]).max() < rounding


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"driver": "toaster"}, "no driver 'toaster'; installed: .*simulator"),
        ({"settings": {"gravity": 9.81}}, "unknown setting 'gravity'"),
    ],
)
def test_an_invalid_request_is_refused(options, message):
    with pytest.raises(InputError, match=message):
        play_offline(ROBOT, make_tilt(), **options)
