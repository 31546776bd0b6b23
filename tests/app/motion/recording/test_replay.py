"""A replay shows what the session showed."""

import numpy as np
import pytest

from rotemina.app.motion.device import LiveHistory
from rotemina.app.motion.recording import Recording, Replay, recovery
from rotemina.app.motion.state import SessionPhase, StateChanged
from rotemina.drivers.contract import ConnectionLostError


@pytest.fixture
def recorded_move(harness, record, monkeypatch):
    """Record a move and a lost link; return recording, events and history before the loss."""
    monkeypatch.setattr(recovery, "_MIN_BATCH_ROWS", 100)  # as many batches as in a long recording
    recorded_session = record(harness)
    events = []
    harness.session.subscribe(events.append)
    recorded_session.rest()
    harness.session.go_to({"x": 0.028})
    recorded_session.step(0.02, 30)
    window = harness.session.history.tail()
    harness.driver.fail("read", ConnectionLostError("cable pulled"))
    recorded_session.step()
    recording = Recording.open(recorded_session.recorder.close())
    return recording, events, window


def test_a_replay_shows_the_same_states_in_the_same_order(recorded_move):
    recording, events, _ = recorded_move
    replay = Replay(recording)
    shown_states = []
    for event in replay.events:
        if event.kind == "state":
            replay.advance(event.host_time_s - replay.host_time_s)
            shown_states.append(replay.snapshot())
    states = [event.state for event in events if isinstance(event, StateChanged)]
    # The first state is the one at the begin of the recording.
    assert [state.phase for state in shown_states[1:]] == [state.phase for state in states]
    assert [state.fault for state in shown_states[1:]] == [state.fault for state in states]
    assert "cable pulled" in shown_states[-1].fault


def test_the_history_is_that_of_the_session(recorded_move):
    recording, _, window = recorded_move
    replay = Replay(recording)
    for _ in range(60):
        replay.advance(0.0137)
    replayed_window = replay.history.tail()
    begin = len(window) - len(replayed_window)
    assert 0 <= begin <= 1
    for name in ("device_time_s", "command", "model", "measured"):
        np.testing.assert_array_equal(getattr(replayed_window, name), getattr(window, name)[begin:])


def test_a_snapshot_during_a_move(recorded_move):
    recording, _, window = recorded_move
    replay = Replay(recording)
    replay.advance(0.25)
    state = replay.snapshot()
    assert state.phase is SessionPhase.MOVING
    assert state.lock_reason == "this is a replay; the machine does not move"
    assert 0.0275 < state.command["x"] < 0.028
    assert 0.0 <= state.age_s < 0.002
    row = int(np.flatnonzero(window.device_time_s == state.device_time_s)[0])
    assert state.measured["x"] == window.measured[row, 0]


def test_seeking_gives_the_same_state_as_playing(recorded_move):
    recording, _, _ = recorded_move
    played, sought = Replay(recording), Replay(recording)
    played.advance(0.3)
    sought.seek(recording.ended_s)
    sought.seek(recording.began_s + 0.3)
    assert sought.snapshot() == played.snapshot()
    np.testing.assert_array_equal(
        sought.history.tail().device_time_s, played.history.tail().device_time_s
    )
    for replay in (played, sought):
        replay.advance(100.0)
        assert replay.has_ended
    assert sought.snapshot() == played.snapshot()


@pytest.mark.parametrize("capacity", [1, 100_000])
def test_seeking_reads_no_more_than_the_history_holds(recorded_move, monkeypatch, capacity):
    recording, _, _ = recorded_move
    full_replay = Replay(recording)
    full_replay.seek(recording.began_s + 0.3)
    history = LiveHistory(recording.axes, seconds=capacity, rate_hz=1.0)
    replay, counts = Replay(recording, history), []
    append = history.append
    monkeypatch.setattr(
        history, "append", lambda s, model: (counts.append(len(s)), append(s, model))
    )
    replay.seek(recording.began_s + 0.3)
    assert sum(counts) == min(capacity, len(full_replay.history.tail()))
    np.testing.assert_array_equal(
        history.tail().command, full_replay.history.tail().command[-capacity:]
    )
    assert replay.snapshot() == full_replay.snapshot()


def test_a_due_sample_is_shown_once_and_time_does_not_go_back(recorded_move):
    recording, _, _ = recorded_move
    replay = Replay(recording)
    replay.seek(float(recording.read_samples().host_time_s[10]))
    replay.advance(0.01)
    assert (np.diff(replay.history.tail().device_time_s) > 0.0).all()
    with pytest.raises(ValueError, match="seek instead"):
        replay.advance(-1.0)


def test_a_reconnection_begins_a_new_history(harness, record):
    recorded_session = record(harness)
    recorded_session.rest()
    harness.session.disconnect()
    recorded_session.step()
    harness.session.connect()
    recorded_session.rest(0.1)
    recording = Recording.open(recorded_session.recorder.close())
    replay = Replay(recording)
    replay.advance(10.0)
    assert len(replay.history.tail()) == len(harness.session.history.tail())
