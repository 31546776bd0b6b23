"""A recorded session: its motion, events and inputs on one clock, without effect on motion."""

import json
import logging

import numpy as np
import pytest

from rotemina.app.motion.inputs import Intent, OperatorAction
from rotemina.app.motion.recording import Recording
from rotemina.app.motion.state import ConnectionState, PlaybackFinished, RunLabels
from rotemina.drivers.contract import ConnectionLostError, DeviceState, LimitError
from rotemina.drivers.inputs import InputIdentity, InputReading
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot


def make_bump(axis="x", start=0.0275, distance=1e-4):
    time_s = np.arange(501) / 1000.0
    command = start + 0.5 * distance * (1 - np.cos(4 * np.pi * time_s))
    return Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: "m"})


def test_recorded_samples_equal_the_history(harness, record):
    recorded_session = record(harness)
    harness.session.go_to({"x": 0.028})
    recorded_session.step(0.02, 40)
    window = harness.session.history.tail()
    path = recorded_session.recorder.close()
    harness.step(0.02, 5)  # the session continues unrecorded
    assert recorded_session.recorder.close() == path
    samples = Recording.open(path).read_samples()
    assert samples.device_time_s[-1] == window.device_time_s[-1]
    begin = len(window) - len(samples)
    assert begin <= 1
    np.testing.assert_array_equal(samples.device_time_s, window.device_time_s[begin:])
    np.testing.assert_array_equal(samples.command, window.command[begin:])
    np.testing.assert_array_equal(samples.measured, window.measured[begin:])
    np.testing.assert_array_equal(samples.model, window.model[begin:])
    assert np.isnan(samples.inputs[:, :3]).all()
    assert np.isfinite(samples.inputs[:, 3:]).all()
    np.testing.assert_allclose(samples.host_time_s, samples.device_time_s + 5.0, atol=1e-9)


def test_the_metadata_describe_the_session(harness, record):
    harness.session.labels = RunLabels.from_text("", " A. Müller\n", "oocyte 7")
    recorded_session = record(harness, settings={"theme": "dark"}, began="2026-11-21 20:33+01:00")
    recording = Recording.open(recorded_session.recorder.close())
    metadata = recording.metadata
    assert recording.robot == load_robot("rotemina")
    assert metadata["driver"] == "unruly"
    assert json.loads(metadata["driver_settings"])["seed"] == 0
    assert metadata["settings"] == '{"theme": "dark"}'
    assert metadata["began"] == "2026-11-21 20:33+01:00"
    assert (metadata["operator"], metadata["sample"]) == ("A. Müller", "oocyte 7")
    assert "run" not in metadata
    assert metadata["program"].startswith("rotemina ")
    assert len(metadata["robot_sha256"]) == len(metadata["settings_sha256"]) == 64
    assert recording.units["thx"] == "rad"


def test_playback_stop_and_refusal_are_events(harness, record):
    recorded_session = record(harness)
    harness.session.play(make_bump())
    recorded_session.step(0.02, 2)
    harness.step_until(DeviceState.IDLE)
    recorded_session.step()
    harness.driver.fail("move_to", LimitError("not now"))
    harness.session.go_to({"x": 0.03})
    recorded_session.step()
    harness.driver.before.clear()
    harness.session.go_to({"x": 0.05})
    recorded_session.step(0.02, 10)
    harness.session.stop()
    stop_s = harness.clock()
    recorded_session.step(0.02, 10)
    recording = Recording.open(recorded_session.recorder.close())
    events = {event.kind: event for event in recording.read_events()}
    assert json.loads(events["playback_end"].details) == {"completed": True, "rows": 501}
    assert events["playback_begin"].host_time_s < events["playback_end"].host_time_s
    assert events["refused"].text == "not now"
    assert events["stop"].host_time_s == stop_s
    kinds = [event.kind for event in recording.read_events()]
    assert kinds.count("stop") == 1
    phases = [event.text for event in recording.read_events() if event.kind == "state"]
    assert "stopping" in phases


def test_a_reconnection_counts_as_another_connection(harness, record):
    recorded_session = record(harness)
    recorded_session.rest()
    harness.driver.fail("read", ConnectionLostError("cable pulled"))
    recorded_session.step()
    harness.driver.before.clear()
    harness.clock.advance(3.0)
    harness.session.reconnect()
    recorded_session.rest()
    recording = Recording.open(recorded_session.recorder.close())
    assert "cable pulled" in next(
        event.text for event in recording.read_events() if event.kind == "fault"
    )
    connections = [event.text for event in recording.read_events() if event.kind == "connection"]
    assert connections == ["connected", "failed", "connecting", "connected"]
    samples = recording.read_samples()
    (begin,) = np.flatnonzero(np.diff(samples.connection))
    assert samples.device_time_s[begin + 1] < samples.device_time_s[begin]
    assert samples.host_time_s[begin + 1] - samples.host_time_s[begin] > 3.0


def test_sticks_intents_notes_and_log_lines_are_recorded(harness, record):
    recorded_session = record(harness)

    class Stick:
        identity = InputIdentity("hid:1:2:3", "A stick", "hid")
        axes = ("X", "Y")
        buttons = ("trigger",)

    recorded_session.recorder.record_reading(Stick(), InputReading(5.5, (0.25, -1.0), (True,)))
    held_actions = frozenset({OperatorAction.CLUTCH})
    recorded_session.recorder.record_intent(
        Intent(5.6, {"x": 0.5}, frozenset({OperatorAction.STOP}), held_actions, "a")
    )
    recorded_session.recorder.record_intent(Intent(5.7, {"x": 0.6, "y": 0.1}, device="a"))
    recorded_session.recorder.record_intent(Intent(5.8, {}, device="a", loss_reason="unplugged"))
    recorded_session.recorder.record_note("the cell looks fine")
    logging.getLogger("rotemina.test").warning("a %s line", "log")
    recording = Recording.open(recorded_session.recorder.close())
    logging.getLogger("rotemina.test").warning("too late")
    stick = recording.read_channel("input hid:1:2:3")
    assert {key: column.tolist() for key, column in stick.items()} == {
        "host_time_s": [5.5], "X": [0.25], "Y": [-1.0], "trigger": [1.0],
    }  # fmt: skip
    intent = recording.read_channel("intent")
    np.testing.assert_array_equal(intent["x"], [0.5, 0.6, np.nan])
    np.testing.assert_array_equal(intent["y"], [np.nan, 0.1, np.nan])
    actions = [(e.host_time_s, e.text) for e in recording.read_events() if e.kind == "action"]
    assert actions == [
        (5.6, "pressed stop"),
        (5.6, "holds clutch"),
        (5.6, "driven by a"),
        (5.7, "released clutch"),
        (5.8, "lost: unplugged"),
    ]
    assert [e.text for e in recording.read_events() if e.kind == "note"] == ["the cell looks fine"]
    (line,) = [event for event in recording.read_events() if event.kind == "log"]
    assert line.text == "a log line"
    assert json.loads(line.details) == {"level": "WARNING", "logger": "rotemina.test"}


def test_motion_continues_while_the_disk_is_full(harness, record, disk):
    recorded_session = record(harness, opener=disk.open)
    recorded_session.rest()
    disk.room = recorded_session.recorder.writer.bytes_written + 1000
    harness.session.play(make_bump())
    for _ in range(200):
        recorded_session.step()
    (finished,) = harness.list_events(PlaybackFinished)
    assert finished.completed
    assert harness.session.snapshot().connection is ConnectionState.CONNECTED
    (notice,) = recorded_session.notices
    assert "the motion continues" in notice
    disk.room = None
    recorded_session.step()
    recording = Recording.open(recorded_session.recorder.close())
    steps_s = np.diff(recording.read_samples().device_time_s)
    assert steps_s.max() == pytest.approx(1e-3)
