"""Recordings as records and as trajectories that can be played."""

from dataclasses import replace
from datetime import datetime

import numpy as np
import pytest

from rotemina.app.errors import RecordingError
from rotemina.app.motion.recording import Recording, make_record, make_trajectory, recovery
from rotemina.app.motion.recording.exporting import export_record, make_record_pieces
from rotemina.app.motion.state import PlaybackFinished
from rotemina.sim.comparison import compare
from rotemina.sim.errors import OutOfLimitsError
from rotemina.sim.records import Tap, read_record
from rotemina.sim.robot_files import load_robot


@pytest.fixture
def recorded_move(harness, record, monkeypatch):
    """Record a rest, a move of two axes, a third axis stopped on its way, and a rest."""
    monkeypatch.setattr(recovery, "_MIN_BATCH_ROWS", 100)  # as many batches as in a long recording
    recorded_session = record(harness)
    recorded_session.rest()
    harness.session.go_to({"x": 0.028, "thx": 6.5e-4})
    recorded_session.step(0.02, 30)
    harness.session.go_to({"y": 0.05})
    recorded_session.step(0.02, 20)
    harness.session.stop()
    recorded_session.rest()
    return Recording.open(recorded_session.recorder.close())


def test_a_record_has_the_samples_of_the_device(recorded_move):
    samples = recorded_move.read_samples()
    exported = make_record(recorded_move)
    np.testing.assert_array_equal(exported.signal("y", Tap.CMD), samples.command[:, 1])
    np.testing.assert_array_equal(exported.signal("thx", Tap.U), samples.inputs[:, 3])
    np.testing.assert_array_equal(exported.signal("zn", Tap.MEAS), samples.measured[:, 5])
    assert not exported.has("x", Tap.U)
    assert exported.time_s[0] == 0.0
    assert dict(exported.metadata) == {
        "mode": "open_loop",
        "history": "unknown",
        "robot": "RoTeMiNa",
        "driver": "unruly",
        "robot_sha256": recorded_move.metadata["robot_sha256"],
        "machine_kind": "simulated",
        "model": recorded_move.metadata["model"],
        "recording": "session.arrows",
        "recording_id": recorded_move.metadata["id"],
        "recording_from_s": f"{samples.host_time_s[0] - recorded_move.began_s:.6f}",
    }
    comparison = compare(load_robot("rotemina"), exported)
    assert comparison.record is exported


def test_a_section_states_its_operator_and_its_own_start(recorded_move):
    labels = {"began": "2026-11-21T20:33:00+01:00", "operator": "A. Müller", "sample": ""}
    recorded_move.metadata = {**recorded_move.metadata, **labels}
    metadata = make_record(
        recorded_move, recorded_move.began_s + 0.3, recorded_move.began_s + 0.5
    ).metadata
    offset = datetime.fromisoformat(metadata["began"]) - datetime.fromisoformat(labels["began"])
    assert offset.total_seconds() == pytest.approx(float(metadata["recording_from_s"]), abs=1e-3)
    assert metadata["operator"] == "A. Müller"
    assert "sample" not in metadata


def test_the_exported_file_reads_back_bit_by_bit(recorded_move, tmp_path):
    path = tmp_path / "out.csv.gz"
    begin_s = recorded_move.began_s + 0.3
    count = export_record(recorded_move, path, begin_s, begin_s + 0.2)
    exported, record = read_record(path), make_record(recorded_move, begin_s, begin_s + 0.2)
    assert count == len(exported.time_s)
    assert 199 <= count <= 201
    np.testing.assert_array_equal(exported.values, record.values)
    np.testing.assert_array_equal(exported.time_s, record.time_s)
    assert dict(exported.metadata).items() >= dict(record.metadata).items()


def test_pieces_continue_each_other(recorded_move):
    whole = make_record(recorded_move)
    pieces = list(make_record_pieces(recorded_move))
    assert len(pieces) > 2
    np.testing.assert_array_equal(np.concatenate([piece.time_s for piece in pieces]), whole.time_s)


def test_the_machine_can_play_a_recording(recorded_move, make_harness):
    began_s, ended_s = recorded_move.began_s, recorded_move.ended_s
    samples = recorded_move.read_samples()
    trajectory = make_trajectory(recorded_move, began_s, ended_s, 1e-3)
    assert trajectory.commands.axes == ("x", "y", "thx")
    second = make_harness()
    second.session.play(trajectory)
    second.step_until_idle()
    (finished,) = second.list_events(PlaybackFinished)
    assert finished.completed
    for column, axis in ((0, "x"), (1, "y"), (3, "thx")):
        played = finished.record.signal(axis, Tap.CMD)
        np.testing.assert_allclose(
            played, samples.command[: len(played), column], rtol=0, atol=1e-12
        )
    # Another period stays on the path.
    commands = make_trajectory(recorded_move, began_s, ended_s, 0.8e-3).commands
    since_s = samples.device_time_s - samples.device_time_s[0]
    expected = np.interp(commands.time_s, since_s, samples.command[:, 0])
    np.testing.assert_allclose(commands.signal("x", Tap.CMD), expected, rtol=0, atol=1e-12)
    assert commands.time_s[1] == 0.8e-3


def test_an_unplayable_section_is_refused_with_the_reason(recorded_move):
    began_s, ended_s = recorded_move.began_s, recorded_move.ended_s
    middle_s = began_s + 0.27
    for begin_s, end_s, message in (
        (middle_s, ended_s, "axis x moves at the start.*choose an earlier start"),
        (began_s, middle_s, "axis x moves at the end.*choose a later end"),
        (began_s, began_s + 0.1, "no axis was commanded to move"),
        (ended_s + 1.0, ended_s + 2.0, "no samples in this section; the recording lasts"),
    ):
        with pytest.raises(RecordingError, match=message) as refusal:
            make_trajectory(recorded_move, begin_s, end_s, 1e-3)
        if middle_s in (begin_s, end_s):
            # No field has untranslated words.
            fields = dict(refusal.value.args[0].fields)
            assert fields == {"path": recorded_move.path, "axis": "x", "rest_s": 0.02}


def test_the_limits_of_the_playing_machine_apply(recorded_move):
    robot = load_robot("rotemina")
    slow_robot = replace(robot, axes={**robot.axes, "x": replace(robot.axes["x"], max_speed=1e-4)})
    with pytest.raises(OutOfLimitsError, match="x"):
        make_trajectory(
            recorded_move, recorded_move.began_s, recorded_move.ended_s, 1e-3, robot=slow_robot
        )


def test_a_gap_during_a_move_is_refused(harness, record):
    recorded_session = record(harness)
    recorded_session.rest()
    harness.session.go_to({"x": 0.029})
    recorded_session.step()
    recorded_session.session._subscribers._taps.clear()  # as if these samples had found no room
    harness.step(0.02, 3)
    recorded_session.session.tap(recorded_session.recorder._on_samples)
    recorded_session.step(0.02, 40)
    recording = Recording.open(recorded_session.recorder.close())
    with pytest.raises(RecordingError, match="ms of samples are missing during a move"):
        make_trajectory(recording, recording.began_s, recording.ended_s, 1e-3)


def test_two_connections_cannot_become_one_record(harness, record, tmp_path):
    recorded_session = record(harness)
    recorded_session.rest()
    harness.session.disconnect()
    recorded_session.step()
    harness.session.connect()
    recorded_session.rest()
    recording = Recording.open(recorded_session.recorder.close())
    for export in (
        lambda: export_record(recording, tmp_path / "out.csv"),
        lambda: make_record(recording),
        lambda: make_trajectory(recording, recording.began_s, recording.ended_s, 1e-3),
    ):
        with pytest.raises(RecordingError, match=r"reconnected 0\.2"):
            export()
    assert not (tmp_path / "out.csv").exists()
    assert len(make_record(recording, end_s=recording.began_s + 0.1).time_s) == 100
