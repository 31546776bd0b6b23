"""A replay shows what the session showed."""

import numpy as np
import pytest

from rotemina.app.motion.recent_history import LiveHistory
from rotemina.app.motion.recording import recovery
from rotemina.app.motion.recording.recording_reader import Recording
from rotemina.app.motion.recording.replay import Replay
from rotemina.app.motion.state import Phase, StateChanged
from rotemina.drivers.errors import ConnectionLostError


@pytest.fixture
def session(stepped, record, monkeypatch):
    """A move, then a lost link; with the states that the session told on the way."""
    monkeypatch.setattr(recovery, "_ROWS", 100)  # as many batches as a long recording has
    recorded = record(stepped)
    seen = []
    stepped.session.subscribe(seen.append)
    recorded.rest()
    stepped.session.go_to({"x": 0.028})
    recorded.step(0.02, 30)
    window = stepped.session.history.tail()

    def lose():
        raise ConnectionLostError("cable pulled")

    stepped.driver.before["read"] = lose
    recorded.step()
    recording = Recording.open(recorded.recorder.close())
    return recording, seen, window


def test_the_same_states_in_the_same_order(session):
    recording, seen, _ = session
    replay = Replay(recording)
    shown = []
    for event in replay.events:
        if event.kind == "state":
            replay.advance(event.host_time_s - replay.host_time_s)
            shown.append(replay.snapshot())
    asked = [one.state for one in seen if isinstance(one, StateChanged)]
    # The first state is that at the begin of the recording.
    assert [one.phase for one in shown[1:]] == [one.phase for one in asked]
    assert [one.fault for one in shown[1:]] == [one.fault for one in asked]
    assert "cable pulled" in shown[-1].fault


def test_the_history_is_that_of_the_session(session):
    recording, _, window = session
    replay = Replay(recording)
    for _ in range(60):
        replay.advance(0.0137)
    shown = replay.history.tail()
    begin = len(window) - len(shown)
    assert 0 <= begin <= 1
    np.testing.assert_array_equal(shown.device_time_s, window.device_time_s[begin:])
    np.testing.assert_array_equal(shown.command, window.command[begin:])
    np.testing.assert_array_equal(shown.model, window.model[begin:])
    np.testing.assert_array_equal(shown.measured, window.measured[begin:])


def test_a_snapshot_in_mid_move(session):
    recording, _, window = session
    replay = Replay(recording)
    replay.advance(0.25)
    state = replay.snapshot()
    assert state.phase is Phase.MOVING
    assert state.locked == "this is a replay; the machine does not move"
    assert 0.0275 < state.command["x"] < 0.028
    assert 0.0 <= state.age_s < 0.002
    row = int(np.flatnonzero(window.device_time_s == state.device_time_s)[0])
    assert state.measured["x"] == window.measured[row, 0]


def test_seeking_is_as_having_come_there(session):
    recording, _, _ = session
    walked, jumped = Replay(recording), Replay(recording)
    walked.advance(0.3)
    jumped.seek(recording.ended_s)
    jumped.seek(recording.began_s + 0.3)
    assert jumped.snapshot() == walked.snapshot()
    np.testing.assert_array_equal(
        jumped.history.tail().device_time_s, walked.history.tail().device_time_s
    )
    for each in (walked, jumped):
        each.advance(100.0)
        assert each.ended
    assert jumped.snapshot() == walked.snapshot()


@pytest.mark.parametrize("capacity", [1, 137, 100_000])
def test_a_jump_reads_no_more_than_the_history_holds(session, monkeypatch, capacity):
    recording, _, _ = session
    whole = Replay(recording)
    whole.seek(recording.began_s + 0.3)
    history = LiveHistory(recording.axes, seconds=capacity, rate_hz=1.0)
    replay, appended = Replay(recording, history), []
    append = history.append
    monkeypatch.setattr(
        history, "append", lambda s, model: (appended.append(len(s)), append(s, model))
    )
    replay.seek(recording.began_s + 0.3)
    assert sum(appended) == min(capacity, len(whole.history.tail()))
    np.testing.assert_array_equal(history.tail().command, whole.history.tail().command[-capacity:])
    assert replay.snapshot() == whole.snapshot()


def test_a_sample_that_is_due_just_now_is_shown_once(session):
    recording, _, _ = session
    replay = Replay(recording)
    replay.seek(float(recording.samples().host_time_s[10]))
    replay.advance(0.01)
    assert (np.diff(replay.history.tail().device_time_s) > 0.0).all()


def test_a_reconnection_begins_a_new_history(stepped, record):
    recorded = record(stepped)
    recorded.rest()
    stepped.session.disconnect()
    recorded.step()
    stepped.session.connect()
    recorded.rest(0.1)
    recording = Recording.open(recorded.recorder.close())
    replay = Replay(recording)
    replay.advance(10.0)
    assert len(replay.history.tail()) == len(stepped.session.history.tail())


def test_time_does_not_go_back(session):
    with pytest.raises(ValueError, match="seek instead"):
        Replay(session[0]).advance(-1.0)
