"""Recordings as records and trajectories: what was done, and done again."""

from dataclasses import replace
from datetime import datetime

import numpy as np
import pytest

from rotemina.app.motion.recording.errors import RecordingError
from rotemina.app.motion.recording.exporting import export, record_of, record_pieces, trajectory
from rotemina.app.motion.recording.recording_reader import Recording
from rotemina.app.motion.state import PlaybackFinished
from rotemina.sim.comparison.comparison import compare
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError


@pytest.fixture
def moved(stepped, record):
    """A rest, a move of two axes, a stop on the way of a third, a rest."""
    recorded = record(stepped)
    recorded.rest()
    stepped.session.go_to({"x": 0.028, "thx": 6.5e-4})
    recorded.step(0.02, 30)
    stepped.session.go_to({"y": 0.05})
    recorded.step(0.02, 20)
    stepped.session.stop()
    recorded.rest()
    return Recording.open(recorded.recorder.close())


def test_a_record_has_what_the_device_told(moved, tmp_path):
    samples = moved.samples()
    made = record_of(moved)
    np.testing.assert_array_equal(made.signal("y", Tap.CMD), samples.command[:, 1])
    np.testing.assert_array_equal(made.signal("thx", Tap.U), samples.inputs[:, 3])
    np.testing.assert_array_equal(made.signal("zn", Tap.MEAS), samples.measured[:, 5])
    assert not made.has("x", Tap.U)
    assert made.time_s[0] == 0.0
    assert dict(made.metadata) == {
        "mode": "open_loop",
        "history": "unknown",
        "robot": "RoTeMiNa",
        "driver": "unruly",
        "robot_sha256": moved.metadata["robot_sha256"],
        "machine_kind": "simulated",
        "model": moved.metadata["model"],
        "recording": "session.arrows",
        "recording_id": moved.metadata["id"],
        "recording_from_s": f"{samples.host_time_s[0] - moved.began_s:.6f}",
    }
    comparison = compare(load_robot("rotemina"), made)
    assert comparison.record is made


def test_a_stretch_says_who_made_it_and_when_it_began_itself(moved):
    said = {"began": "2026-11-21T20:33:00+01:00", "operator": "A. Müller", "sample": ""}
    moved.metadata = {**moved.metadata, **said}
    told = record_of(moved, moved.began_s + 0.3, moved.began_s + 0.5).metadata
    began = datetime.fromisoformat(told["began"]) - datetime.fromisoformat(said["began"])
    assert began.total_seconds() == pytest.approx(float(told["recording_from_s"]), abs=1e-3)
    assert told["operator"] == "A. Müller"
    assert "sample" not in told


def test_the_exported_file_reads_back_bit_by_bit(moved, tmp_path, monkeypatch):
    path = tmp_path / "out.csv.gz"
    begin_s = moved.began_s + 0.3
    count = export(moved, path, begin_s, begin_s + 0.2)
    exported, made = read_record(path), record_of(moved, begin_s, begin_s + 0.2)
    assert count == len(exported.time_s)
    assert 199 <= count <= 201
    np.testing.assert_array_equal(exported.values, made.values)
    np.testing.assert_array_equal(exported.time_s, made.time_s)
    assert dict(exported.metadata).items() >= dict(made.metadata).items()


def test_pieces_go_on_from_each_other(make_writer, feed):
    writer = make_writer()
    for part in range(30):
        feed(writer, 5000 * part, 5000, portion=5000)
        writer.run_once()
    path = writer.close()
    recording = Recording(path, Recording.open(path)._tables)
    recording.metadata = {
        **recording.metadata, "driver": "none", "robot_file": TWO_AXES,
    }  # fmt: skip
    pieces = list(record_pieces(recording))
    assert len(pieces) == 3
    whole = record_of(recording)
    np.testing.assert_array_equal(np.concatenate([each.time_s for each in pieces]), whole.time_s)


TWO_AXES = """
[robot]
name = "two"
axes = ["x", "thx"]
[axis.x]
kind = "stepper"
range = [0.0, 1.0]
static = true
[axis.thx]
kind = "piezo"
range = [0.0, 1.0]
static = true
gain = 1.0
"""


def test_a_recording_is_played_again_by_the_machine(moved, make_stepped):
    again = trajectory(moved, moved.began_s, moved.ended_s, 1e-3)
    assert again.commands.axes == ("x", "y", "thx")
    other = make_stepped()
    other.session.play(again)
    other.until_idle()
    (finished,) = other.told(PlaybackFinished)
    assert finished.completed
    recorded = moved.samples().command
    for column, axis in ((0, "x"), (1, "y"), (3, "thx")):
        played = finished.record.signal(axis, Tap.CMD)
        np.testing.assert_allclose(played, recorded[: len(played), column], rtol=0, atol=1e-12)


def test_another_period_stays_on_the_path(moved):
    again = trajectory(moved, moved.began_s, moved.ended_s, 0.8e-3).commands
    samples = moved.samples()
    since_s = samples.device_time_s - samples.device_time_s[0]
    expected = np.interp(again.time_s, since_s, samples.command[:, 0])
    np.testing.assert_allclose(again.signal("x", Tap.CMD), expected, rtol=0, atol=1e-12)
    assert again.time_s[1] == 0.8e-3


def test_what_cannot_be_played_says_why(moved):
    middle_s = moved.began_s + 0.27
    for begin_s, end_s, words in (
        (middle_s, moved.ended_s, "axis x moves at the start.*choose an earlier start"),
        (moved.began_s, middle_s, "axis x moves at the end.*choose a later end"),
        (moved.began_s, moved.began_s + 0.1, "no axis was commanded to move"),
        (
            moved.ended_s + 1.0,
            moved.ended_s + 2.0,
            "no samples in this section; the recording lasts",
        ),
    ):
        with pytest.raises(RecordingError, match=words):
            trajectory(moved, begin_s, end_s, 1e-3)


def test_the_limits_of_the_machine_that_plays_hold(moved):
    robot = load_robot("rotemina")
    slow = replace(robot, axes={**robot.axes, "x": replace(robot.axes["x"], max_speed=1e-4)})
    with pytest.raises(OutOfLimitsError, match="x"):
        trajectory(moved, moved.began_s, moved.ended_s, 1e-3, robot=slow)


def test_a_gap_in_mid_move_is_refused(stepped, record):
    recorded = record(stepped)
    recorded.rest()
    stepped.session.go_to({"x": 0.029})
    recorded.step()
    recorded.session._subscribers._taps.clear()  # as if what came meanwhile had found no room
    stepped.step(0.02, 3)
    recorded.session.tap(recorded.recorder._on_samples)
    recorded.step(0.02, 40)
    recording = Recording.open(recorded.recorder.close())
    with pytest.raises(RecordingError, match="ms of samples are missing during a move"):
        trajectory(recording, recording.began_s, recording.ended_s, 1e-3)


def test_two_connections_make_no_record(stepped, record, tmp_path):
    recorded = record(stepped)
    recorded.rest()
    stepped.session.disconnect()
    recorded.step()
    stepped.session.connect()
    recorded.rest()
    recording = Recording.open(recorded.recorder.close())
    for made in (
        lambda: export(recording, tmp_path / "out.csv"),
        lambda: record_of(recording),
        lambda: trajectory(recording, recording.began_s, recording.ended_s, 1e-3),
    ):
        with pytest.raises(RecordingError, match=r"reconnected 0\.2"):
            made()
    assert not (tmp_path / "out.csv").exists()
    assert len(record_of(recording, end_s=recording.began_s + 0.1).time_s) == 100
