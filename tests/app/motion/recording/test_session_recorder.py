"""A session recorded: what it did, said and was told, on one clock; motion is never concerned."""

import json
import logging

import numpy as np
import pytest

from rotemina.app.motion.recording.recording_reader import Recording
from rotemina.app.motion.run_labels import RunLabels
from rotemina.app.motion.state import Connection, PlaybackFinished
from rotemina.app.motion.teleoperation.intent import Action, Intent
from rotemina.drivers.errors import ConnectionLostError, LimitError
from rotemina.drivers.inputs.device import InputIdentity, InputReading
from rotemina.drivers.samples import DeviceState
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot


def bump(axis="x", start=0.0275, distance=1e-4):
    time_s = np.arange(501) / 1000.0
    command = start + 0.5 * distance * (1 - np.cos(4 * np.pi * time_s))
    return Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: "m"})


def kinds(recording):
    return [event.kind for event in recording.events()]


def test_samples_are_those_of_the_history(stepped, record):
    recorded = record(stepped)
    stepped.session.go_to({"x": 0.028})
    recorded.step(0.02, 40)
    window = stepped.session.history.tail()
    recording = Recording.open(recorded.recorder.close())
    samples = recording.samples()
    begin = len(window) - len(samples)
    assert begin <= 1
    np.testing.assert_array_equal(samples.device_time_s, window.device_time_s[begin:])
    np.testing.assert_array_equal(samples.command, window.command[begin:])
    np.testing.assert_array_equal(samples.measured, window.measured[begin:])
    np.testing.assert_array_equal(samples.model, window.model[begin:])
    assert np.isnan(samples.inputs[:, :3]).all()
    assert np.isfinite(samples.inputs[:, 3:]).all()
    np.testing.assert_allclose(samples.host_time_s, samples.device_time_s + 5.0, atol=1e-9)


def test_what_holds_for_the_whole_is_there(stepped, record):
    stepped.session.labels = RunLabels.typed("", " A. Müller\n", "oocyte 7")
    recorded = record(stepped, settings={"theme": "dark"}, began="2026-11-21 20:33+01:00")
    recording = Recording.open(recorded.recorder.close())
    about = recording.metadata
    assert recording.robot == load_robot("rotemina")
    assert about["driver"] == "unruly"
    assert json.loads(about["driver_settings"])["seed"] == 0
    assert about["settings"] == '{"theme": "dark"}'
    assert about["began"] == "2026-11-21 20:33+01:00"
    assert (about["operator"], about["sample"]) == ("A. Müller", "oocyte 7")
    assert "run" not in about
    assert about["program"].startswith("rotemina ")
    assert len(about["robot_sha256"]) == len(about["settings_sha256"]) == 64
    assert recording.units["thx"] == "rad"


def test_a_playback_a_stop_and_a_refusal_are_events(stepped, record):
    recorded = record(stepped)
    stepped.session.play(bump())
    recorded.step(0.02, 2)
    stepped.until(DeviceState.IDLE)
    recorded.step()
    stepped.driver.before["move_to"] = refuse
    stepped.session.go_to({"x": 0.03})
    recorded.step()
    stepped.driver.before.clear()
    stepped.session.go_to({"x": 0.05})
    recorded.step(0.02, 10)
    stepped.session.stop()
    asked_s = stepped.clock()
    recorded.step(0.02, 10)
    recording = Recording.open(recorded.recorder.close())
    told = {event.kind: event for event in recording.events()}
    assert json.loads(told["playback_end"].details) == {"completed": True, "rows": 501}
    assert told["playback_begin"].host_time_s < told["playback_end"].host_time_s
    assert told["refused"].text == "not now"
    assert told["stop"].host_time_s == asked_s
    assert kinds(recording).count("stop") == 1
    phases = [event.text for event in recording.events() if event.kind == "state"]
    assert "stopping" in phases


def refuse():
    raise LimitError("not now")


def test_a_reconnection_is_another_connection(stepped, record):
    recorded = record(stepped)
    recorded.rest()
    stepped.driver.before["read"] = lose
    recorded.step()
    stepped.driver.before.clear()
    stepped.clock.advance(3.0)
    stepped.session.reconnect()
    recorded.rest()
    recording = Recording.open(recorded.recorder.close())
    assert "cable pulled" in next(e.text for e in recording.events() if e.kind == "fault")
    connections = [event.text for event in recording.events() if event.kind == "connection"]
    assert connections == ["connected", "failed", "connecting", "connected"]
    samples = recording.samples()
    (begin,) = np.flatnonzero(np.diff(samples.connection))
    assert samples.device_time_s[begin + 1] < samples.device_time_s[begin]
    assert samples.host_time_s[begin + 1] - samples.host_time_s[begin] > 3.0


def lose():
    raise ConnectionLostError("cable pulled")


def test_sticks_intents_notes_and_log_lines(stepped, record):
    recorded = record(stepped)

    class Stick:
        identity = InputIdentity("hid:1:2:3", "A stick", "hid")
        axes = ("X", "Y")
        buttons = ("trigger",)

    recorded.recorder.record_reading(Stick(), InputReading(5.5, (0.25, -1.0), (True,)))
    held = frozenset({Action.CLUTCH})
    recorded.recorder.record_intent(Intent(5.6, {"x": 0.5}, frozenset({Action.STOP}), held, "a"))
    recorded.recorder.record_intent(Intent(5.7, {"x": 0.6, "y": 0.1}, device="a"))
    recorded.recorder.record_intent(Intent(5.8, {}, device="a", lost="unplugged"))
    recorded.recorder.note("the cell looks fine")
    logging.getLogger("rotemina.test").warning("a %s line", "log")
    recording = Recording.open(recorded.recorder.close())
    logging.getLogger("rotemina.test").warning("too late")
    stick = recording.channel("input hid:1:2:3")
    assert {key: each.tolist() for key, each in stick.items()} == {
        "host_time_s": [5.5], "X": [0.25], "Y": [-1.0], "trigger": [1.0],
    }  # fmt: skip
    intent = recording.channel("intent")
    np.testing.assert_array_equal(intent["x"], [0.5, 0.6, np.nan])
    np.testing.assert_array_equal(intent["y"], [np.nan, 0.1, np.nan])
    actions = [(e.host_time_s, e.text) for e in recording.events() if e.kind == "action"]
    assert actions == [
        (5.6, "pressed stop"),
        (5.6, "holds clutch"),
        (5.6, "driven by a"),
        (5.7, "released clutch"),
        (5.8, "lost: unplugged"),
    ]
    assert [e.text for e in recording.events() if e.kind == "note"] == ["the cell looks fine"]
    (line,) = [event for event in recording.events() if event.kind == "log"]
    assert line.text == "a log line"
    assert json.loads(line.details) == {"level": "WARNING", "logger": "rotemina.test"}


def test_motion_goes_on_while_the_disk_is_full(stepped, record, disk):
    recorded = record(stepped, opener=disk.open)
    recorded.rest()
    disk.room = recorded.recorder.writer.bytes_written + 1000
    stepped.session.play(bump())
    for _ in range(200):
        recorded.step()
    (finished,) = stepped.told(PlaybackFinished)
    assert finished.completed
    assert stepped.session.snapshot().connection is Connection.CONNECTED
    (notice,) = recorded.notices
    assert "the motion continues" in notice
    disk.room = None
    recorded.step()
    recording = Recording.open(recorded.recorder.close())
    steps_s = np.diff(recording.samples().device_time_s)
    assert steps_s.max() == pytest.approx(1e-3)


def test_after_close_the_session_goes_on_unrecorded(stepped, record):
    recorded = record(stepped)
    recorded.rest()
    path = recorded.recorder.close()
    stepped.step(0.02, 5)
    assert recorded.recorder.close() == path
    assert Recording.open(path).count <= 200
