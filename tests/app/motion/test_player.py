"""Playing without waiting gives the record of a live playback."""

import numpy as np
import pytest

from rotemina.app.motion.player import play_offline
from rotemina.app.motion.state import PlaybackFinished
from rotemina.drivers.errors import LimitError
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.errors import InputError
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.trajectory.dry_run import dry_run

ROBOT = load_robot("rotemina")


def tilt(amplitude=1e-5):
    time_s = np.arange(1001) / 2000.0
    command = 5e-4 + amplitude * (1 - np.cos(2 * np.pi * 4 * time_s))
    return Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})


def test_the_record_is_the_trajectory_with_what_was_measured():
    record = play_offline(ROBOT, tilt(), seed=2)
    np.testing.assert_array_equal(record.time_s, tilt().time_s)
    np.testing.assert_array_equal(record.signal("thx", Tap.CMD), tilt().signal("thx", Tap.CMD))
    modelled = nominal_response(ROBOT, tilt()).signal("thx", Tap.MEAS)
    deviation = record.signal("thx", Tap.MEAS) - modelled
    assert deviation.std() == pytest.approx(ROBOT.axes["thx"].sensor.noise_floor, rel=0.1)


def test_it_is_the_record_of_a_live_playback_with_the_same_seed(make_stepped):
    live = make_stepped(driver=Simulator, settings={"seed": 2})
    live.step(0.3)
    live.session.play(tilt())
    live.until_idle()
    lived = live.told(PlaybackFinished)[0].record
    np.testing.assert_array_equal(lived.values, play_offline(ROBOT, tilt(), seed=2).values)


def test_progress_rises_to_one():
    seen = []
    long = Record.from_signals(np.arange(5.0), {("x", Tap.CMD): np.full(5, 0.02)}, {"x": "m"})
    play_offline(ROBOT, long, progress=seen.append)
    assert seen == sorted(seen)
    assert seen[0] == 0.0
    assert seen[-1] == 1.0


def test_what_breaks_a_limit_is_refused():
    with pytest.raises(LimitError, match="axis thx"):
        play_offline(ROBOT, tilt(amplitude=4e-4))


def test_under_control_the_record_of_distant_rows_is_the_model_to_rounding():
    """The loop ran at the device's ticks, which are the record's rows."""
    emps = load_robot("emps")
    command = 0.06 + 1e-3 * np.arange(7)
    asked = Record.from_signals(np.arange(7) * 0.5, {("q", Tap.CMD): command}, {"q": "m"})
    record = play_offline(emps, asked)
    assert record.closed_loop
    np.testing.assert_array_equal(record.time_s, np.arange(3001) / 1000)
    modelled = nominal_response(emps, record)
    # From 0.5 s on: the model begins at the command, the device where the force has pushed it.
    for tap, rounding in ((Tap.MEAS, 1e-12), (Tap.U, 1e-7)):
        deviation = record.signal("q", tap) - modelled.signal("q", tap)
        assert np.abs(deviation[500:]).max() < rounding


def test_a_checked_trajectory_is_played_too():
    checked = dry_run(ROBOT, tilt()).require()
    np.testing.assert_array_equal(
        play_offline(ROBOT, checked, seed=2).values, play_offline(ROBOT, tilt(), seed=2).values
    )


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"driver": "toaster"}, "no driver 'toaster'; installed: .*simulator"),
        ({"settings": {"gravity": 9.81}}, "unknown setting 'gravity'"),
    ],
)
def test_a_wrong_request_is_named(options, words):
    with pytest.raises(InputError, match=words):
        play_offline(ROBOT, tilt(), **options)
